#pragma once

#include "diagnosis/noise.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {

/// Root mean square of a residual over the rows marked 1; NaN where there are none.
double rms_on(const Eigen::ArrayXd& residual, const Eigen::ArrayXd& rows);

/// Noise of an equation over the rows marked 1.
double noise_on(const Frame& frame, const std::vector<double>& level, const Eigen::ArrayXd& rows);

/// 95 % interval of the ratio of two errors over the rows marked 1, by 400 resamplings of eighths
/// of the recordings.
void resample_ratio(const Frame& frame, const Eigen::ArrayXd& rows, const Eigen::ArrayXd& before,
                    const Eigen::ArrayXd& after, HoldoutProof& proof);

}  // namespace flexspline::studies
