#pragma once

#include "diagnosis/selection.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {

/// The equation whose residual is the errors' unit: the transmitted torque where a cause acts on
/// it, else that of the first cause.
Equation equation_to_prove(const Frame& frame, const Selection& selection);

/// Errors of the baseline and of the final model on the rows that are held out, each row by fits to
/// the other folds (folds_of). SI, at the output; the interval of the ratio by 400 resamplings of
/// blocks of the held-out recordings.
struct Proof {
  HoldoutProof holdout;
  double rmse_train_before = kNotComputed;
  double rmse_train_after = kNotComputed;
  /// Error of the final model over that without a cause, by cause, and of the baseline with an
  /// absent effect over the baseline; in the equations that the cause acts on, each over its noise.
  std::vector<double> cause_ratio;
  std::vector<double> placebo_ratio;
  /// Measured torque of the equation to prove as the baseline and the final model predict it, all
  /// rows: where held out by the fits that did not see them, else by those to all recordings.
  Eigen::ArrayXd before;
  Eigen::ArrayXd after;
  std::vector<ModelFit> by_fold;  ///< the final model, by fold of folds_of, fitted without its rows
};
/// The same for any number of threads; 0: as many as the machine has.
Result<Proof> prove(const Frame& frame, const Selection& selection, unsigned threads);

/// The same, with the causes withdrawn that do not lower the error on recordings held out; the
/// worst first, each time proved anew.
Result<Proof> confirm(const Frame& frame, const Limits& limits, Selection& selection);

}  // namespace flexspline::studies
