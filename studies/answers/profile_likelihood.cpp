#include "answers/profile_likelihood.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexspline::studies {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeastRise = 1e-4;  // below which a solver's tolerance is seen

/// Curvature at the estimate, for independent noise: rise over the square of the distance, at the
/// nearest held fit on each side. NaN where no rise can be seen.
double curvature_of(const ProfileInput& input) {
  double sum = 0.0;
  double sides = 0.0;
  for (const double sign : {-1.0, 1.0}) {
    double nearest = std::numeric_limits<double>::infinity();
    double own = kNaN;
    for (const HeldFit& one : input.held) {
      const double distance = sign * (one.value - input.estimate);
      if (!(distance > 0.0) || distance >= nearest || one.rise < kLeastRise) continue;
      nearest = distance;
      own = one.rise / (distance * distance);
    }
    if (std::isnan(own)) continue;
    sum += own;
    sides += 1.0;
  }
  return sides > 0.0 ? sum / sides : kNaN;
}

}  // namespace

ProfileLikelihood::ProfileLikelihood(const ProfileInput& input)
    : roots_{{input.estimate, 0.0}}, widening_(input.std * std::sqrt(curvature_of(input))) {
  if (!(widening_ > 0.0)) widening_ = kNaN;
  const double scale = std::isnan(widening_) ? 1.0 : 1.0 / (widening_ * widening_);
  for (const HeldFit& one : input.held) {
    const double root = std::sqrt(std::max(0.0, scale * one.rise));
    roots_.push_back({one.value, one.value < input.estimate ? -root : root});
  }
  std::ranges::sort(roots_, {}, &Root::value);
}

double ProfileLikelihood::rise(double value) const {
  const auto after = std::ranges::lower_bound(roots_, value, {}, &Root::value);
  if (after == roots_.end()) return kNaN;
  if (after->value == value) return after->root * after->root;
  if (after == roots_.begin()) return kNaN;
  const Root& before = *(after - 1);
  const double u = (value - before.value) / (after->value - before.value);
  const double root = (1.0 - u) * before.root + u * after->root;
  return root * root;
}

std::optional<double> ProfileLikelihood::crossing(double sign) const {
  const double wanted = std::sqrt(kProfileRise);
  std::vector<Root> outwards = roots_;
  if (sign < 0.0) std::ranges::reverse(outwards);
  const auto estimate = std::ranges::find(outwards, 0.0, &Root::root);
  for (auto at = estimate; at != outwards.end() && at + 1 != outwards.end(); ++at) {
    const double from = sign * at->root;
    const double to = sign * (at + 1)->root;
    if (to < wanted) continue;
    return at->value + (wanted - from) / (to - from) * ((at + 1)->value - at->value);
  }
  return std::nullopt;
}

}  // namespace flexspline::studies
