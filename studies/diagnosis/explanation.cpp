#include "diagnosis/explanation.hpp"

#include <algorithm>

namespace flexspline::studies {
namespace {

// Sums of squares of an equation with the same weights: before, after, and what noise asks for.
struct Misfit {
  double before = 0.0;
  double after = 0.0;
  double noise = 0.0;
};

Misfit misfit_of(const Findings& base, const Findings& final, Equation equation) {
  const std::size_t e = index_of(equation);
  const auto& weight = final.weight[e];
  return {(base.fit.residual[e] * weight).square().sum(),
          (final.fit.residual[e] * weight).square().sum(),
          static_cast<double>((weight > 0.0).count())};
}

/// Weighted sums of squares over all equations: what the causes took, what a coordinate still
/// orders, and what there was.
struct Balance {
  double taken = 0.0;
  double ordered = 0.0;
  double before = 0.0;
};

Balance balance_of(const Frame& frame, const Selection& s) {
  Balance b;
  for (Equation equation : frame.equations) {
    const Misfit m = misfit_of(s.baseline, s.final, equation);
    b.before += m.before;
    b.taken += m.before - m.after;
    for (const CoordinateScore& score : s.after) {
      if (score.equation != equation) continue;
      b.ordered += score.share * m.after;
      break;
    }
  }
  return b;
}

const CoordinateScore* score_of(const std::vector<CoordinateScore>& scores, Equation equation,
                                std::string_view coordinate) {
  const auto found = std::ranges::find_if(scores, [&](const CoordinateScore& score) {
    return score.equation == equation && score.coordinate == coordinate;
  });
  return found == scores.end() ? nullptr : &*found;
}

}  // namespace

double misfit_removed(const Frame& frame, const Selection& s) {
  double before = 0.0;
  double after = 0.0;
  for (Equation equation : frame.equations) {
    const Misfit m = misfit_of(s.baseline, s.final, equation);
    const double colour = s.final.noise[index_of(equation)].colour;
    before += std::max(m.before - m.noise, 0.0) / colour;
    after += std::max(m.after - m.noise, 0.0) / colour;
  }
  return before > 0.0 ? std::clamp(1.0 - after / before, 0.0, 1.0) : 0.0;
}

bool is_left(const CoordinateScore& score, const Limits& limits) {
  return score.statistic > limits.gain && score.share > limits.tenth;
}

const Accepted* left_unnamed(const Selection& s, const Limits& limits) {
  const Accepted* most = nullptr;
  if (!s.accepted.empty()) return most;
  for (const Accepted& a : s.immaterial) {
    if (a.trial.cause.row->of_baseline()) continue;
    const bool seen = a.trial.net_gain >= limits.named_gain && a.trial.removed > limits.tenth;
    if (seen && (most == nullptr || a.trial.removed > most->trial.removed)) most = &a;
  }
  return most;
}

double worst_misfit(const Frame& frame, const Findings& findings) {
  double worst = 0.0;
  for (Equation equation : frame.equations) {
    const Misfit m = misfit_of(findings, findings, equation);
    worst = std::max(worst, m.after / m.noise);
  }
  return worst;
}

bool too_many(const Selection& s, const Limits& limits) {
  const bool remains = !s.after.empty() && is_left(s.after.front(), limits);
  return s.accepted.size() > limits.causes - (remains ? 1 : 0);
}

bool explains_enough(const Frame& frame, const Selection& s, const Limits& limits) {
  if (too_many(s, limits)) return false;
  const Balance b = balance_of(frame, s);
  const double left = s.after.empty() ? 0.0 : s.after.front().statistic;
  if (left > limits.gain && b.taken < limits.explained() * (b.taken + b.ordered)) return false;
  return s.removed >= limits.explained() || worst_misfit(frame, s.final) < limits.as_noise() ||
         b.taken > limits.half * b.before;
}

bool clears_its_coordinate(const Selection& s, const Accepted& cause, const Limits& limits) {
  if (std::ranges::any_of(s.after, [&](const auto& score) { return is_left(score, limits); })) {
    return false;
  }
  return std::ranges::any_of(cause.trial.cause.form->at, [&](Equation equation) {
    const auto* score = score_of(s.before, equation, cause.trial.cause.row->coordinate);
    return score != nullptr && is_left(*score, limits);
  });
}

}  // namespace flexspline::studies
