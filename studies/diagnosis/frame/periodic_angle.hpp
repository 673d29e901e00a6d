#pragma once

#include <vector>

#include <Eigen/Core>

#include "flexspline/core/recording.hpp"
#include "flexspline/core/rig_residuals.hpp"

namespace flexspline::studies {

/// The part of a motor's angle that comes and goes with the wave generator's turn, rad:
/// P(theta) = sum_k a_k sin(k theta) + b_k cos(k theta). A kinematic error makes the motor follow
/// it too fast for a smoothing spline, so it is taken out before smoothing and put back exactly.
struct PeriodicAngle {
  struct Term {
    double order, sine, cosine;
  };
  std::vector<Term> terms;

  double value(double theta) const;
  double slope(double theta) const;
  double curvature(double theta) const;
  /// P' theta' by row; empty where nothing is periodic.
  Eigen::ArrayXd rate(const Eigen::ArrayXd& theta, const Eigen::ArrayXd& speed) const;
};

/// Orders 1, 2, 2 (1 + 1/N) and 4 by regression of the raw torsion on the turns, both about running
/// parabolas of 101 samples; those of more than ten standard errors, of independent samples and
/// by the scatter from recording to recording. Empty but on the free rig.
PeriodicAngle periodic_angle(const RecordingSet& set);

/// A recording's channels with the periodic part kept out of the smoothing; on the free rig with a
/// torsion that is smoothed as it is.
Result<DriveChannels> channels_with(const RecordingSet& set, const Recording& recording,
                                    const PeriodicAngle& periodic);

}  // namespace flexspline::studies
