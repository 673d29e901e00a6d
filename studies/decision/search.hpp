#pragma once

#include "decision/fit.hpp"

namespace flexspline::studies::decision {

/// The constants of the decision. Derivation or calibration of each: docs/decisions/0014.
struct Calibration {
  double interest = 0.008;    ///< floor of interest, share of the largest torque
  double probability = 0.95;  ///< least of a name's class
  double power = 0.5;         ///< of the likelihood: what misspecification leaves of it
  double burst_ratio = 3.0;   ///< power of a window's innovations over the recording's
  double to_noise = 1.5;      ///< held-out error over noise that counts as explained
};

/// A cause beside a model: its columns' share of the likelihood, variances as they are.
struct Candidate {
  Taken cause;
  double beside = 0.0;   ///< gain of log likelihood beside the remainder's components
  double instead = 0.0;  ///< and in their place, over the model without them
  double gain = 0.0;     ///< the best of them once the variances are estimated anew, in score
};

/// Every cause that is not in the model, each with its best form and shapes, best first.
std::vector<Candidate> screen(const Bench& bench, const Fit& fit);

/// What a candidate's score may come to, where it could stand for components of the remainder.
double promise(const Candidate& candidate, const Fit& fit);

/// The model with one more cause: variances, shapes and baseline fitted.
Fit extended(const Bench& bench, const Fit& fit, const Taken& cause);

/// The model without one of its causes.
Fit without(const Bench& bench, const Fit& fit, std::size_t cause);

/// Shapes that no step finds, by a walk on the likelihood.
Fit with_walked_shapes(const Bench& bench, Fit fit);

/// What a gain in score is worth as odds, natural logarithm: tempered, and less what a search over
/// so many rows costs.
double log_odds(double gain, const Calibration& calibration);

/// Causes one after the other while their odds are those of a name, and out again those that later
/// ones made needless.
Fit search(const Bench& bench, Fit fit, const Calibration& calibration);

}  // namespace flexspline::studies::decision
