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

}  // namespace

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

}  // namespace flexspline::studies
