#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sanity/check.hpp"
#include "sanity/evidence.hpp"

namespace flexspline::data {
namespace {

constexpr std::string_view kRatio =
    "check gear_ratio, the unit of the angle and amplitude_deg (at the output)";
constexpr std::string_view kUnit =
    "check the unit of the angle's channel, and amplitude_deg (at the output)";
constexpr SanityVerdict kOtherRatio{"check_ratio", Severity::error, kRatio};
constexpr SanityVerdict kNearlyRatio{"check_ratio", Severity::warning, kRatio};
constexpr SanityVerdict kOtherUnits{"check_units", Severity::error, kUnit};
constexpr SanityVerdict kNearly{"check_units", Severity::warning, kUnit};

constexpr double kAlike = 1.3;
constexpr double kMistaken = 1.6;

double off(double factor) { return std::abs(std::log(factor)); }

/// Half the range of what the bench moves or the largest it comes to, at the output, over what the
/// set states: whichever is nearer, as motions about another place are stated either way.
std::vector<Factor> factors_of(const ObservedSet& all) {
  const double ratio = all.set.rig == Rig::locked ? all.constant("gear_ratio") : 1.0;
  std::vector<Factor> list;
  for (const Recording& whole : all.set.recordings) {
    const Recording recording = without_marked(whole);
    const auto* motion = held_motion(all.set, recording);
    if (motion == nullptr || motion->empty() || !(recording.amplitude.value_or(0.0) > 0.0))
      continue;
    const double half = 0.5 * range_of(*motion) / std::abs(ratio);
    const double most =
        std::abs(*std::ranges::max_element(*motion, {}, [](double x) { return std::abs(x); })) /
        std::abs(ratio);
    const double factor =
        std::ranges::min({half, most}, {},
                         [&](double moved) { return off(moved / *recording.amplitude); }) /
        *recording.amplitude;
    if (factor > 0.0 && std::isfinite(factor)) list.push_back({recording.id, factor});
  }
  return list;
}

SanityFinding finding(const ObservedSet& all, const std::string& recording, double factor) {
  const double ratio = all.constant("gear_ratio");
  const bool of_ratio = all.set.rig == Rig::locked && !is_off(factor, 4.0);
  const std::string mistake = mistake_of(factor, ratio);
  std::string what =
      fmt::format("the motion is {:.3g} times the amplitude that dataset.toml states{}", factor,
                  mistake.empty() ? "" : fmt::format(" ({})", mistake));
  const bool mistaken = is_off(factor, kMistaken);
  if (of_ratio) return (mistaken ? kOtherRatio : kNearlyRatio).on(recording, std::move(what));
  return (mistaken ? kOtherUnits : kNearly).on(recording, std::move(what));
}

std::vector<SanityFinding> find(const ObservedSet& all) {
  const auto factors = factors_of(all);
  if (factors.empty()) return {};
  const Agreement agreement = agreement_of(factors, kAlike);
  std::vector<SanityFinding> list;
  if (is_off(agreement.common, kAlike)) list.push_back(finding(all, "", agreement.common));
  for (const Factor& other : agreement.others) {
    if (is_off(other.value, kAlike)) list.push_back(finding(all, other.recording, other.value));
  }
  return list;
}

}  // namespace

SanityRow describe_nominal_amplitude() {
  return {"nominal_amplitude",
          "the recorded motion against the amplitude that the set states",
          {kOtherRatio, kNearlyRatio, kOtherUnits, kNearly},
          find};
}

}  // namespace flexspline::data
