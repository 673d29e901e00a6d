#pragma once

#include <Eigen/Core>

namespace flexspline::studies {

/// Sum of the samples before each, and of all: one more than there are samples.
Eigen::ArrayXd running_sum(const Eigen::ArrayXd& samples);

/// Weights of the middle value of a parabola fitted to 2 half + 1 equidistant samples (Savitzky and
/// Golay 1964).
Eigen::ArrayXd parabola_weights(Eigen::Index half);

/// Samples less the middle of the parabola about each; count - 2 half of them.
Eigen::ArrayXd about_parabola(const Eigen::Ref<const Eigen::ArrayXd>& samples,
                              const Eigen::ArrayXd& weights);

}  // namespace flexspline::studies
