#include "diagnosis/prove.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/folds.hpp"
#include "diagnosis/held_out_error.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr int kSteps = 8;

// The cause that does worst on recordings held out.
std::optional<std::size_t> unconfirmed(const Proof& proof, double most) {
  std::optional<std::size_t> worst;
  for (std::size_t i = 0; i < proof.cause_ratio.size(); ++i) {
    if (!(proof.cause_ratio[i] >= most)) continue;
    if (!worst || proof.cause_ratio[i] > proof.cause_ratio[*worst]) worst = i;
  }
  return worst;
}

/// Findings whose weights leave the held-out rows out of the fit.
Findings on_training(Findings findings, const ArrayXd& out) {
  for (ArrayXd& weight : findings.weight) {
    if (weight.size() == out.size()) weight *= 1.0 - out;
  }
  return findings;
}

// The model's causes taken over, all parameters fitted to the training rows.
Result<ModelFit> refitted(const Frame& frame, const Findings& training) {
  Findings copy = training;
  const auto done = fit_all(frame, copy, kSteps);
  if (!done) return tl::unexpected(done.error());
  return copy.fit;
}

/// Residuals of the models compared, every held-out row by the fit that did not see it; 0
/// elsewhere.
struct HeldOut {
  PerEquation base, final, placebo;
  std::vector<ArrayXd> without;  ///< of the final model less each cause, in that cause's equation
  ArrayXd before, after;         ///< predictions of the equation to prove, all rows
  double train_before = 0.0;     ///< sums of squares of the equation to prove, all folds
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
          {s.accepted.size(), zero},
          s.baseline.fit.prediction[e],
          s.final.fit.prediction[e]};
}

Result<void> take_causes(const Frame& frame, const Selection& s, const Findings& final,
                         const ArrayXd& rows, HeldOut& pool) {
  for (std::size_t i = 0; i < s.accepted.size(); ++i) {
    const std::size_t e = index_of(first_equation(frame, *s.accepted[i].trial.cause.form));
    const auto without = reduced(frame, final, s.immaterial.size() + i, kSteps);
    if (!without) return tl::unexpected(without.error());
    pool.without[i] += without->residual[e] * rows;
  }
  return {};
}

// The best of the causes that were tried and are not there.
Result<void> take_placebo(const Frame& frame, const Selection& s, Findings base,
                          const ArrayXd& rows, HeldOut& pool) {
  if (s.accepted.empty() || s.accepted.front().field.empty()) return {};
  base.fit = s.accepted.front().field.front().fit;
  const auto fit = refitted(frame, base);
  if (!fit) return tl::unexpected(fit.error());
  take(pool.placebo, fit->residual, rows);
  return {};
}

Result<void> take_fold(const Frame& frame, const Selection& s, const ArrayXd& out, HeldOut& pool) {
  Findings base = on_training(s.baseline, out);
  base.weight = on_training(s.final, out).weight;
  base.noise = s.final.noise;
  auto base_fit = refitted(frame, base);
  if (!base_fit) return tl::unexpected(base_fit.error());
  base.fit = std::move(*base_fit);
  Findings final = on_training(s.final, out);
  auto final_fit = refitted(frame, final);
  if (!final_fit) return tl::unexpected(final_fit.error());
  final.fit = std::move(*final_fit);
  const ArrayXd held = out * frame.usable;
  const ArrayXd train = (1.0 - out) * frame.usable;
  const std::size_t e = index_of(equation_to_prove(frame, s));
  pool.before = (out > 0.0).select(base.fit.prediction[e], pool.before);
  pool.after = (out > 0.0).select(final.fit.prediction[e], pool.after);
  take(pool.base, base.fit.residual, held);
  take(pool.final, final.fit.residual, held);
  pool.train_before += (base.fit.residual[e].square() * train).sum();
  pool.train_after += (final.fit.residual[e].square() * train).sum();
  pool.train_rows += train.sum();
  const auto causes = take_causes(frame, s, final, held, pool);
  if (!causes) return causes;
  return take_placebo(frame, s, base, held, pool);
}

void prove_causes(const Frame& frame, const Selection& s, const HeldOut& pool, const ArrayXd& held,
                  Proof& proof) {
  for (std::size_t i = 0; i < s.accepted.size(); ++i) {
    const std::size_t e = index_of(first_equation(frame, *s.accepted[i].trial.cause.form));
    proof.cause_ratio.push_back(rms_on(pool.final[e], held) / rms_on(pool.without[i], held));
    const double instead = rms_on(pool.placebo[e], held);
    proof.placebo_ratio.push_back(instead > 0.0 ? instead / rms_on(pool.base[e], held)
                                                : kNotComputed);
  }
}

// What explained much where it was fitted and nothing elsewhere leaves a question, not an answer.
bool leaves_a_question(const Frame& frame, const Limits& limits, const Selection& s,
                       std::size_t cause) {
  double chi_square = 0.0;
  for (Equation equation : frame.equations) chi_square += s.final.chi_square(equation);
  const double gain = s.accepted[cause].trial.gain;
  return gain > limits.unproved * (chi_square + gain);
}

// The error on recordings held out with a cause over that without it, which no cause may reach.
double most_of(const Limits& limits, const Selection& s) {
  return s.remainder ? limits.held_out_of_more : limits.held_out;
}

// What explains the same signal nearly as well as a cause that fails on recordings held out, if it
// holds there itself.
Result<std::optional<Selection>> with_proven_rival(const Frame& frame, const Limits& limits,
                                                   Selection s, std::size_t cause) {
  auto& rivals = s.accepted[cause].rivals;
  std::erase_if(rivals, [&](const Trial& t) {
    return std::ranges::any_of(s.final.fit.model.causes,
                               [&](const ActiveCause& c) { return c.row == t.cause.row; });
  });
  if (rivals.empty()) return std::nullopt;
  auto other =
      with_rival(frame, limits, s, cause,
                 "it does not lower the error on recordings held out, an alternative does");
  if (!other) return tl::unexpected(other.error());
  if (other->accepted.size() < s.accepted.size() || !other->accepted.back().material) {
    return std::nullopt;
  }
  const auto proof = prove(frame, *other);
  if (!proof) return tl::unexpected(proof.error());
  if (!(proof->cause_ratio.back() < most_of(limits, *other))) return std::nullopt;
  return std::move(*other);
}

}  // namespace

Equation equation_to_prove(const Frame& frame, const Selection& selection) {
  Equation first = frame.equations.front();
  for (const Accepted& a : selection.accepted) {
    for (Equation at : a.trial.cause.form->at) {
      if (at == Equation::torsion && frame.has(at)) return at;
    }
  }
  if (selection.accepted.empty()) return first;
  for (Equation at : selection.accepted.front().trial.cause.form->at) {
    if (frame.has(at)) return at;
  }
  return first;
}

Result<Proof> prove(const Frame& frame, const Selection& s) {
  HeldOut pool = nothing_yet(frame, s);
  for (const ArrayXd& fold : folds_of(frame)) {
    const auto taken = take_fold(frame, s, fold, pool);
    if (!taken) return tl::unexpected(taken.error());
  }
  const std::size_t e = index_of(equation_to_prove(frame, s));
  const ArrayXd held = held_out(frame) * frame.usable;
  Proof proof;
  proof.before = pool.before;
  proof.after = pool.after;
  HoldoutProof& h = proof.holdout;
  h.rmse_before = rms_on(pool.base[e], held);
  h.rmse_after = rms_on(pool.final[e], held);
  h.ratio = h.rmse_after / h.rmse_before;
  h.noise_floor = noise_on(frame, s.final.noise[e].level, held);
  proof.rmse_train_before = std::sqrt(pool.train_before / pool.train_rows);
  proof.rmse_train_after = std::sqrt(pool.train_after / pool.train_rows);
  resample_ratio(frame, held, pool.base[e], pool.final[e], h);
  prove_causes(frame, s, pool, held, proof);
  if (e == index_of(Equation::motor)) {
    for (double* value : {&h.rmse_before, &h.rmse_after, &h.noise_floor, &proof.rmse_train_before,
                          &proof.rmse_train_after}) {
      *value *= frame.ratio;
    }
  }
  return proof;
}

Result<Proof> confirm(const Frame& frame, const Limits& limits, Selection& s) {
  while (true) {
    auto proof = prove(frame, s);
    if (!proof) return proof;
    const auto worst = unconfirmed(*proof, most_of(limits, s));
    if (!worst) return proof;
    auto exchanged = with_proven_rival(frame, limits, s, *worst);
    if (!exchanged) return tl::unexpected(exchanged.error());
    if (*exchanged) {
      s = std::move(**exchanged);
      continue;
    }
    s.unproved = s.unproved || leaves_a_question(frame, limits, s, *worst);
    const auto left_out =
        leave_out(frame, limits, s, *worst,
                  proof->cause_ratio[*worst] < limits.held_out
                      ? "it hardly lowers the error on recordings held out, and something is left"
                      : "it does not lower the error on recordings held out");
    if (!left_out) return tl::unexpected(left_out.error());
  }
}

}  // namespace flexspline::studies
