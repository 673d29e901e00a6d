#pragma once

#include <cstddef>

namespace flexspline::studies {

/// What the probability of a name is read from: errors on recordings held out, and what else is
/// said.
struct NameEvidence {
  double ratio = 1.0;       ///< error with the cause over the error without it
  double over_noise = 1.0;  ///< error of the whole model over the noise
  double left_over = 0.0;   ///< CauseEvidence::left_over
  std::size_t alternatives = 0;
};

/// Probability that a name is right:
///     ln p/(1 - p) = b0 + b1 ln(1 - r^2) + b2 ln m + b3 ln(1000 l) + b4 k,
/// r the ratio (1 - r^2 at least 0.002: a cause that explains nothing), m the error over the noise,
/// from 1 to the root of 2, l what is left over beside it, from 0.001 to 0.3, k the alternatives.
/// The b are a logistic regression on names that were given on simulated cases of two generators,
/// right and wrong ones (docs/decisions/0027): a frequency among such cases, of which one in four
/// hides something outside the catalogue or in a single recording. NaN where a number is.
double probability_right(const NameEvidence& evidence);

}  // namespace flexspline::studies
