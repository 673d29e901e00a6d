#pragma once

#include <vector>

#include "uncertainty/coloured_noise.hpp"

namespace flexspline::estimators {

/// Where parameters may lie about their estimate, the noise being known from the same recordings.
struct NoiseMixture {
  Eigen::VectorXd std;
  Eigen::VectorXd lower;  ///< 2.5 % point less the estimate
  Eigen::VectorXd upper;
};

/// Integrates over share and time of every output's noise by their restricted likelihood, flat in
/// share and ln time: at each of them the parameters follow Student's law about generalised least
/// squares, and what they follow altogether is the mixture. In short recordings that is wider than
/// the law at the noise that was estimated. outputs: series with slopes, residuals in units of
/// their noise; at: what was estimated, with sigma 1; freedom: degrees of freedom.
NoiseMixture over_noise(const std::vector<std::vector<TimedSeries>>& outputs,
                        const std::vector<ColouredNoise>& at, double freedom);

}  // namespace flexspline::estimators
