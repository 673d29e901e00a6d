#include "diagnosis/search/explanation.hpp"

#include <algorithm>
#include <cmath>

namespace flexspline::studies {
bool is_left(const CoordinateScore& score, const Limits& limits) {
  return score.statistic > limits.gain && score.share > limits.tenth;
}

const Accepted* left_unnamed(const Selection& s, const Limits& limits) {
  const Accepted* most = nullptr;
  if (!s.accepted.empty()) return most;
  for (const Accepted& a : s.immaterial) {
    if (a.trial.cause.row->of_baseline()) continue;
    const bool seen = a.trial.net_gain >= limits.named_gain && a.trial.removed > limits.tenth &&
                      a.trial.size > limits.half * limits.interest;
    if (seen && (most == nullptr || a.trial.removed > most->trial.removed)) most = &a;
  }
  return most;
}

bool is_beyond_noise(const Frame& frame, const HoldoutProof& h, const Limits& limits) {
  const double own =
      std::sqrt(std::max(h.rmse_after * h.rmse_after - h.noise_floor * h.noise_floor, 0.0));
  return h.over_noise() * h.over_noise() > limits.as_noise() &&
         own > limits.trifle() * frame.torque_range;
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
