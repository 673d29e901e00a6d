#include "diagnosis/explanation.hpp"

#include <algorithm>

namespace flexspline::studies {
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
    const std::size_t e = index_of(equation);
    const auto& weight = findings.weight[e];
    const double rows = static_cast<double>((weight > 0.0).count());
    worst = std::max(worst, (findings.fit.residual[e] * weight).square().sum() / rows);
  }
  return worst;
}

}  // namespace flexspline::studies
