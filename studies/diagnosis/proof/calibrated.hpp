#pragma once

#include <cstddef>
#include <vector>

namespace flexspline::studies {

/// What the probability of a name is read from: errors on recordings held out, and what else is
/// said.
struct NameEvidence {
  double ratio = 1.0;              ///< error with the cause over the error without it
  double over_noise = 1.0;         ///< error of the whole model over the noise
  double before_over_noise = 1.0;  ///< of the baseline
  double left_over = 0.0;          ///< CauseEvidence::left_over
  std::size_t alternatives = 0;
  /// What the search without each outer fold says that it is, 0 of one that did not find it; empty
  /// where there were no folds.
  std::vector<double> in_folds = {};
};

/// Probability that a name is right:
///     ln p/(1 - p) = b0 + b1 ln(1 - r^2) + b2 q + b3 ln(1000 l) + b4 k,
/// r the ratio (1 - r^2 at least 0.002: a cause that explains nothing), q = (m^2 - 1)/m0^2 what the
/// model leaves beyond noise of the baseline's mean square, m and m0 their errors over the noise,
/// from 0 to 1, l what is left over beside the cause, from 0.001 to 0.3, k the alternatives. The b
/// are a logistic regression on names that were given on simulated cases of two generators and on
/// effects added to recordings by others, right and wrong ones (docs/decisions/0037): a frequency
/// among such cases, of which one in four hides something outside the catalogue or in a single
/// recording. Where there were outer folds, the mean of this and what their searches say: a
/// bagged posterior (Huggins and Miller 2023), which does not hang on rows that another recording
/// of the same drive would not have had. NaN where a number is.
double probability_right(const NameEvidence& evidence);

}  // namespace flexspline::studies
