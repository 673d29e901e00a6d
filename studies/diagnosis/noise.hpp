#pragma once

#include "diagnosis/model.hpp"

namespace flexspline::studies {

/// Noise of one equation's residual.
struct EquationNoise {
  std::vector<double> level;  ///< standard deviation by segment, Nm
  double colour = 1.0;        ///< long-run variance over variance: 1 for white noise
  Eigen::Index alike = 1;     ///< rows over which it hardly changes
};

/// What is left of a residual when all that changes slowly is taken out: standard deviation about a
/// running parabola of 51 samples (Savitzky and Golay 1964), by recording, its freedom counted. A
/// model error that changes within a few samples counts as noise.
std::vector<double> noise_levels(const Frame& frame, const Eigen::ArrayXd& residual);

/// 1 + 2 sum of autocorrelations over forty lags, of the residual about a running parabola of 161
/// samples; at least 1. Slow noise passes the parabola only in part, so of a first-order process
/// longer than some samples this is far too little: the limits of a decision were set with it.
double noise_colour(const Frame& frame, const Eigen::ArrayXd& residual);

/// Rows over which the noise stays alike: the first lag at which its autocorrelation, measured as
/// for noise_colour(), is a half or less; 1 for white noise.
Eigen::Index rows_alike(const Frame& frame, const Eigen::ArrayXd& residual);

/// Weights of the rows that a fit looks at. Rows whose noise is alike tell one thing: one of each
/// `alike` rows of a recording stands for all, by the root of their number, so that sums of squares
/// keep their size. 1000 rows of a recording stay, where it has them.
Eigen::ArrayXd weights_of_fit(const Frame& frame, const Eigen::ArrayXd& weight, Eigen::Index alike);

/// Weights 1/level of usable rows.
Eigen::ArrayXd weights_of(const Frame& frame, const std::vector<double>& level);

}  // namespace flexspline::studies
