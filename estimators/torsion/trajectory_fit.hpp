#pragma once

#include <string>
#include <vector>

#include "flexspline/core/simulate.hpp"
#include "torsion/start.hpp"

namespace flexspline::estimators {

/// Which way the torsion law is simulated: torsion from torque by eq. (3), or torque from motion by
/// eq. (4).
enum class Direction { torsion, torque };

/// A fitted torsion law with the linearisation at it.
struct TrajectoryFit {
  LinearStart at;
  LeastSquaresSolution solution;
  Eigen::MatrixXd covariance;
  Linearisation linear;
  Direction direction;
  std::string refused{};  ///< which material term was left out for its sign; empty: none
};

/// Counts the noise of the motion into effort_sigma, by the slope d tau / d phi of the law at a
/// start: effort follows motion.
Result<void> add_motion_noise(std::vector<PreparedRecord>& records, const LinearStart& at);

/// Fits eq. (4). Offset, inertia, delay and the highest terms of ln h that lie within three
/// standard deviations of zero are taken out one round after another: kept, they would only pass
/// their uncertainty on to g^-1. ln h keeps two terms. So is an inertia below zero, whatever its
/// uncertainty; `refused` says so of one that is material.
Result<TrajectoryFit> fit_torque(const LinearStart& start,
                                 const std::vector<PreparedRecord>& records,
                                 const SolverSettings& settings);

/// Fits eq. (3) from a fit of eq. (4), with an initial torsion for every record.
Result<TrajectoryFit> fit_torsion(const TrajectoryFit& from,
                                  const std::vector<PreparedRecord>& records,
                                  const SolverSettings& settings,
                                  const IntegratorSettings& integrator);

/// What a fit of eq. (4) leaves, root mean square over all rows, Nm (N): residual and noise.
struct Leftover {
  double residual = 0.0;
  double noise = 0.0;
};
Leftover leftover(const TrajectoryFit& fit, const std::vector<PreparedRecord>& records);

/// Counts what the model misses, the same everywhere, into effort_sigma: otherwise the recordings
/// with the least noise, not the most evidence, would decide.
void add_misfit(std::vector<PreparedRecord>& records, const Leftover& left);

}  // namespace flexspline::estimators
