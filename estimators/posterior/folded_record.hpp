#pragma once

#include <vector>

#include "torsion/prepared_record.hpp"
#include "uncertainty/coloured_noise.hpp"

namespace flexspline::estimators {

/// A harmonic of the reconstructed motion whose cosine and sine (order 0: constant) carry an error
/// each; rad/s and rad.
struct MotionError {
  double angular_frequency = 0.0;
  double sigma = 0.0;
};

/// A recording as a regression of its torque sees it. Where its motion repeats in whole samples,
/// the cycles stand as one mean cycle, and what the torque of the single cycles differs from it by
/// is the noise, measured without any model; elsewhere every row stands for itself and the noise is
/// still to be taken from what a fit leaves.
struct FoldedRecord {
  std::vector<double> time, position, velocity, acceleration, torque;
  double phase_zero = 0.0;    ///< s, where the phase of `motion` is zero
  ColouredNoise noise;        ///< of torque as it stands here, Nm
  bool repeats = false;       ///< noise comes from the repeats
  double motion_sigma = 0.0;  ///< rad, of every row on its own; 0 where `motion` holds the errors
  double speed_sigma = 0.0;   ///< rad/s, likewise, of the reconstructed speed
  std::vector<MotionError> motion{};
};

FoldedRecord folded(const PreparedRecord& record);

/// Noise of a series of residuals of this record.
ColouredNoise noise_of(const FoldedRecord& record, std::vector<double> residual);

}  // namespace flexspline::estimators
