#include "diagnosis/proof/prove.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "diagnosis/frame/folds.hpp"
#include "diagnosis/proof/held_out_error.hpp"
#include "flexspline/core/in_parallel.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

/// Findings whose weights leave the held-out rows out of the fit.
Findings on_training(Findings findings, const ArrayXd& out) {
  for (PerEquation* weights : {&findings.weight, &findings.fit_weight}) {
    for (ArrayXd& weight : *weights) {
      if (weight.size() == out.size()) weight *= 1.0 - out;
    }
  }
  return findings;
}

/// Residuals of the models compared, every held-out row by the fit that did not see it; 0
/// elsewhere.
struct HeldOut {
  PerEquation base, final, placebo;
  std::vector<PerEquation> without;  ///< of the final model less each cause
  ArrayXd before, after;             ///< predictions of the equation to prove, all rows
  double train_before = 0.0;         ///< sums of squares of the equation to prove, all folds
  double train_after = 0.0;
  double train_rows = 0.0;
};

void take(PerEquation& pool, const PerEquation& residual, const ArrayXd& rows) {
  for (std::size_t e = 0; e < pool.size(); ++e) {
    if (residual[e].size() > 0) pool[e] += residual[e] * rows;
  }
}

HeldOut nothing_yet(const Frame& frame, const Selection& s) {
  const ArrayXd zero = ArrayXd::Zero(frame.rows());
  const PerEquation each = {zero, zero, zero};
  const std::size_t e = index_of(equation_to_prove(frame, s));
  return {each,
          each,
          each,
          {s.accepted.size(), each},
          s.baseline.fit.prediction[e],
          s.final.fit.prediction[e]};
}

/// The models fitted to the rows that a fold leaves.
struct FoldFits {
  Findings base, final;
  std::vector<ModelFit> without;    ///< of the final model less each cause
  std::optional<ModelFit> placebo;  ///< the best of the causes that were tried and are not there
};

Findings on_weights_of(Findings findings, const Findings& other) {
  findings.weight = other.weight;
  findings.fit_weight = other.fit_weight;
  findings.noise = other.noise;
  return findings;
}

Result<void> fit_both(const Frame& frame, const Selection& s, const ArrayXd& out, FoldFits& fold) {
  fold.base = on_training(on_weights_of(s.baseline, s.final), out);
  fold.final = on_training(s.final, out);
  for (Findings* one : {&fold.base, &fold.final}) {
    const auto done = fit_all(frame, *one, kRefreshSteps, kJudgedFall);
    if (!done) return done;
  }
  return {};
}

Result<void> fit_placebo(const Frame& frame, const Selection& s, FoldFits& fold) {
  if (s.accepted.empty() || s.accepted.front().field.empty()) return {};
  Findings instead = fold.base;
  instead.fit = s.accepted.front().field.front().fit;
  const auto done = fit_all(frame, instead, kRefreshSteps, kJudgedFall);
  if (done) fold.placebo = std::move(instead.fit);
  return done;
}

// What stands in the place of the causes: the model without each, and the placebo.
Result<void> fit_without(const Frame& frame, const Selection& s, FoldFits& fold) {
  for (std::size_t i = 0; i < s.accepted.size(); ++i) {
    auto fit = reduced(frame, fold.final, s.immaterial.size() + i, kRefreshSteps, kJudgedFall);
    if (!fit) return tl::unexpected(fit.error());
    fold.without.push_back(std::move(*fit));
  }
  return fit_placebo(frame, s, fold);
}

Result<std::vector<FoldFits>> fit_folds(const Frame& frame, const Selection& s,
                                        const std::vector<ArrayXd>& folds, unsigned threads) {
  std::vector<FoldFits> fits(folds.size());
  std::vector<Result<void>> done(folds.size());
  in_parallel(folds.size(), threads, [&](std::size_t i) {
    done[i] = fit_both(frame, s, folds[i], fits[i]);
    if (done[i]) done[i] = fit_without(frame, s, fits[i]);
  });
  for (const auto& one : done) {
    if (!one) return tl::unexpected(one.error());
  }
  return fits;
}

void take_fold(const Frame& frame, const Selection& s, const ArrayXd& out, const FoldFits& fold,
               HeldOut& pool) {
  const ArrayXd held = out * frame.usable;
  const ModelFit& base = fold.base.fit;
  const ModelFit& final = fold.final.fit;
  const Equation equation = equation_to_prove(frame, s);
  const std::size_t e = index_of(equation);
  const ArrayXd train = (1.0 - out) * frame.rows_of(equation);
  pool.before = (out > 0.0).select(base.prediction[e], pool.before);
  pool.after = (out > 0.0).select(final.prediction[e], pool.after);
  take(pool.base, base.residual, held);
  take(pool.final, final.residual, held);
  if (fold.placebo) take(pool.placebo, fold.placebo->residual, held);
  for (std::size_t i = 0; i < fold.without.size(); ++i) {
    take(pool.without[i], fold.without[i].residual, held);
  }
  pool.train_before += (base.residual[e].square() * train).sum();
  pool.train_after += (final.residual[e].square() * train).sum();
  pool.train_rows += train.sum();
}

/// Chi square of held-out rows in some equations, over the noise's colour.
struct HeldOutMisfit {
  double chi_square = 0.0;
  double noise = 0.0;  ///< what is expected of noise alone
};

HeldOutMisfit misfit_of(const Frame& frame, const Findings& findings,
                        const std::vector<Equation>& equations, const PerEquation& residual,
                        const ArrayXd& held) {
  HeldOutMisfit misfit;
  for (Equation equation : equations) {
    if (!frame.has(equation)) continue;
    const std::size_t e = index_of(equation);
    const EquationNoise& noise = findings.noise[e];
    const ArrayXd weight = held * weights_of(frame, equation, noise);
    misfit.chi_square += (residual[e] * weight).square().sum() / noise.colour;
    misfit.noise += static_cast<double>((weight > 0.0).count()) / noise.colour;
  }
  return misfit;
}

// Of two that take each other back either is missed beside the other, and both are not: no cause
// helps by more than all of them do. What a cause takes off one that acts elsewhere, too, is seen
// there: its gain is read in all equations that the two tie together.
void prove_causes(const Frame& frame, const Selection& s, const HeldOut& pool, const ArrayXd& held,
                  Proof& proof) {
  for (std::size_t i = 0; i < s.accepted.size(); ++i) {
    const CauseForm& form = *s.accepted[i].trial.cause.form;
    const auto linked = linked_equations(frame, s.final.fit.model.causes, form);
    const auto of = [&](const PerEquation& residual) {
      return misfit_of(frame, s.final, linked, residual, held);
    };
    const double base = of(pool.base).chi_square, instead = of(pool.placebo).chi_square;
    const double with = of(pool.final).chi_square;
    const double without = std::min(of(pool.without[i]).chi_square, base);
    CauseProof cause{.name = {.ratio = std::sqrt(with / without)},
                     .placebo_ratio = instead > 0.0 ? std::sqrt(instead / base) : kNotComputed,
                     .gain = without - with};
    take_errors(frame, s.final, form, pool.base, pool.final, held, cause.name);
    proof.causes.push_back(cause);
  }
}

// That which could not be judged is none.
double held_out_gain(const CauseProof& cause) {
  return std::isnan(cause.gain) ? -std::numeric_limits<double>::infinity() : cause.gain;
}

}  // namespace

Equation equation_to_prove(const Frame& frame, const Selection& selection) {
  std::optional<Equation> first;
  for (const auto* causes : {&selection.accepted, &selection.unnamed}) {
    for (const Accepted& a : *causes) {
      for (Equation at : a.trial.cause.form->at) {
        if (!frame.has(at)) continue;
        if (at == Equation::torsion) return at;
        if (!first) first = at;
      }
    }
  }
  return first.value_or(frame.equations.front());
}

double probability_of(const CauseProof& cause) {
  NameEvidence either = cause.name;
  either.alternatives = 0;
  const double probability = probability_right(either);
  return std::isnan(probability) ? 0.0 : probability;
}

void take_errors(const Frame& frame, const Findings& findings, const CauseForm& form,
                 const PerEquation& before, const PerEquation& after, const ArrayXd& held,
                 NameEvidence& evidence) {
  const HeldOutMisfit base = misfit_of(frame, findings, form.at, before, held);
  const HeldOutMisfit whole = misfit_of(frame, findings, form.at, after, held);
  evidence.before_over_noise = std::sqrt(base.chi_square / base.noise);
  evidence.over_noise = std::sqrt(whole.chi_square / whole.noise);
}

bool is_confirmed(const CauseProof& cause, const Limits& limits) {
  return cause.gain >= limits.gain;
}

std::optional<std::size_t> unconfirmed(const Proof& proof, const Limits& limits) {
  const auto least = std::ranges::min_element(proof.causes, {}, held_out_gain);
  if (least == proof.causes.end() || is_confirmed(*least, limits)) return std::nullopt;
  return least - proof.causes.begin();
}

Result<Proof> prove(const Frame& frame, const Selection& s, unsigned threads) {
  const auto folds = folds_of(frame);
  auto fits = fit_folds(frame, s, folds, threads);
  if (!fits) return tl::unexpected(fits.error());
  HeldOut pool = nothing_yet(frame, s);
  for (std::size_t i = 0; i < folds.size(); ++i) take_fold(frame, s, folds[i], (*fits)[i], pool);
  const Equation equation = equation_to_prove(frame, s);
  const std::size_t e = index_of(equation);
  const ArrayXd held = held_out(frame) * frame.usable;
  const ArrayXd judged = held * frame.rows_of(equation);
  Proof proof;
  proof.before = pool.before;
  proof.after = pool.after;
  HoldoutProof& h = proof.holdout;
  h.rmse_before = rms_on(pool.base[e], judged);
  h.rmse_after = rms_on(pool.final[e], judged);
  h.ratio = h.rmse_after / h.rmse_before;
  h.noise_floor = noise_of(frame, s.final.noise[e], pool.final[e], judged);
  proof.rmse_train_before = std::sqrt(pool.train_before / pool.train_rows);
  proof.rmse_train_after = std::sqrt(pool.train_after / pool.train_rows);
  take_interval(frame, judged, pool.base[e], pool.final[e], h);
  prove_causes(frame, s, pool, held, proof);
  for (FoldFits& fold : *fits) proof.by_fold.push_back(std::move(fold.final.fit));
  if (equation == Equation::motor) {
    for (double* value : {&h.rmse_before, &h.rmse_after, &h.noise_floor, &proof.rmse_train_before,
                          &proof.rmse_train_after}) {
      *value *= frame.ratio;
    }
  }
  return proof;
}

}  // namespace flexspline::studies
