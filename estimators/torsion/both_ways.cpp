#include "torsion/both_ways.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace flexspline::estimators {
namespace {

constexpr std::size_t kBins = 50;
constexpr double kStill = 0.01;      // of the fastest speed: slower is neither way
constexpr double kLeastShare = 0.5;  // of the bins that are passed at all

}  // namespace

Result<void> passed_both_ways(const std::vector<PreparedRecord>& records) {
  const Ranges ranges = ranges_of(records, false);
  const double span = ranges.highest_motion - ranges.lowest_motion;
  std::array<std::array<bool, 2>, kBins> passed{};
  for (const auto& one : records) {
    const auto& m = one.smooth.motion;
    for (std::size_t i = 0; i < m.time.size(); ++i) {
      if (std::abs(m.velocity[i]) < kStill * ranges.velocity) continue;
      const double place = (m.position[i] - ranges.lowest_motion) / span * kBins;
      passed[std::min(static_cast<std::size_t>(place), kBins - 1)][m.velocity[i] > 0.0] = true;
    }
  }
  const auto both = std::ranges::count_if(passed, [](const auto& p) { return p[0] && p[1]; });
  const auto any = std::ranges::count_if(passed, [](const auto& p) { return p[0] || p[1]; });
  const double share = any > 0 ? static_cast<double>(both) / static_cast<double>(any) : 0.0;
  if (share >= kLeastShare) return {};
  const auto up = std::ranges::count_if(passed, [](const auto& p) { return p[1]; });
  const auto down = std::ranges::count_if(passed, [](const auto& p) { return p[0]; });
  return failure(
      ErrorCode::bad_data,
      fmt::format(
          "{} of the range of motion is passed both ways, so f and g^-1 cannot be told apart",
          both == 0 ? std::string("nothing") : fmt::format("{:.0f} %", 100.0 * share)),
      fmt::format("the way {} is missing: record a whole loop, there and back over the same "
                  "torsion",
                  up > down ? "down" : "up"));
}

}  // namespace flexspline::estimators
