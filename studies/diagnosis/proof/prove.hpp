#pragma once

#include <optional>

#include "diagnosis/proof/calibrated.hpp"
#include "diagnosis/search/selection.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {

/// The equation whose residual is the errors' unit: the transmitted torque where a cause acts on
/// it, else that of the first cause.
Equation equation_to_prove(const Frame& frame, const Selection& selection);

/// What recordings held out say of a cause, each equation over its noise: gain and ratio in all
/// equations that the model's causes tie to its own (linked_equations), the rest in its own.
struct CauseProof {
  NameEvidence name;                    ///< what is left over beside it once it is confirmed
  double placebo_ratio = kNotComputed;  ///< of the baseline with an absent effect over the baseline
  double gain = kNotComputed;           ///< by how much it lowers the chi square
};

/// Errors of the baseline and of the final model on the rows that are held out, each row by fits to
/// the other folds (folds_of). SI, at the output; the interval of the ratio by a jackknife over
/// blocks of the held-out recordings (take_interval).
struct Proof {
  HoldoutProof holdout;
  double rmse_train_before = kNotComputed;
  double rmse_train_after = kNotComputed;
  std::vector<CauseProof> causes;  ///< of the selection's accepted ones
  /// Measured torque of the equation to prove as the baseline and the final model predict it, all
  /// rows: where held out by the fits that did not see them, else by those to all recordings.
  Eigen::ArrayXd before;
  Eigen::ArrayXd after;
  std::vector<ModelFit> by_fold;  ///< the final model, by fold of folds_of, fitted without its rows
};

/// That the name of a cause or one of its alternatives is right; 0 of one that could not be judged.
double probability_of(const CauseProof& cause);

/// Takes as evidence of a cause's name, in the equations that it acts on, what residuals of the
/// baseline and of the whole model say on the rows marked 1.
void take_errors(const Frame& frame, const Findings& findings, const CauseForm& form,
                 const PerEquation& before, const PerEquation& after, const Eigen::ArrayXd& held,
                 NameEvidence& evidence);

/// True where recordings held out say that a cause is there.
bool is_confirmed(const CauseProof& cause, const Limits& limits);

/// Of the causes that are not confirmed the one that helps least; none where all are.
std::optional<std::size_t> unconfirmed(const Proof& proof, const Limits& limits);

/// The same for any number of threads; 0: as many as the machine has.
Result<Proof> prove(const Frame& frame, const Selection& selection, unsigned threads);

}  // namespace flexspline::studies
