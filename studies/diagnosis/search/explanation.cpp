#include "diagnosis/search/explanation.hpp"

#include <algorithm>
#include <cmath>

namespace flexspline::studies {
bool is_left(const CoordinateScore& score, const Limits& limits) {
  return score.statistic > limits.gain && score.share > limits.tenth &&
         score.size > limits.half * limits.interest;
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

bool is_fitted_beyond_noise(const Frame& frame, const Findings& findings, const Limits& limits) {
  return std::ranges::any_of(frame.equations, [&](Equation equation) {
    const std::size_t e = index_of(equation);
    const auto& weight = findings.weight[e];
    const double rows = static_cast<double>((weight > 0.0).count());
    const double squares = (findings.fit.residual[e] * weight).square().sum();
    const double own = std::sqrt(std::max(squares - rows, 0.0) / weight.square().sum());
    return squares > limits.as_noise() * rows &&
           own > limits.trifle() * frame.largest_torque(equation);
  });
}

}  // namespace flexspline::studies
