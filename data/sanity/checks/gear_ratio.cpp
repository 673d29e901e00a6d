#include <cmath>

#include <fmt/format.h>

#include "sanity/check.hpp"
#include "sanity/evidence.hpp"

namespace flexspline::data {
namespace {

using Eigen::ArrayXd;

constexpr std::string_view kState = "state turns of the motor for one of the output";
constexpr SanityVerdict kNegative{"check_sign", Severity::error, kState};
constexpr SanityVerdict kNoReduction{"check_ratio", Severity::error, kState};
constexpr SanityVerdict kBackwards{"check_sign", Severity::error,
                                   "check the sign of motor_angle against load_angle"};
constexpr SanityVerdict kOtherRatio{
    "check_ratio", Severity::error,
    "check gear_ratio, the units of both angles, and which column is which"};

constexpr double kMostOff = 1.15;  // of the ratio: windup and kinematic error are less
constexpr double kFollows = 0.9;   // of the motor's variance: less, and the load did not follow

/// Slope of the motor's angle over the load's, alone or beside the torque that winds the gear up,
/// whichever is nearer to the ratio: near a resonance the windup is as large as the motion. A
/// mistaken unit or ratio shows in both.
Regression slope_of(const Observed& o, double ratio) {
  const ArrayXd one = ArrayXd::Ones(o.time.size());
  const Regression alone = regression({o.load_angle, one}, o.motor_angle, o.usable);
  if (o.effort.size() == 0) return alone;
  return nearer_to(ratio, alone,
                   regression({o.load_angle, one, o.effort}, o.motor_angle, o.usable));
}

/// The slopes over the ratio that the set states.
std::vector<Factor> slopes(const ObservedSet& all) {
  std::vector<Factor> list;
  for (const Observed& o : all.recordings) {
    if (o.motor_angle.size() == 0 || o.load_angle.size() == 0) continue;
    const Regression fit = slope_of(o, all.constant("gear_ratio"));
    if (fit.explained < kFollows) continue;
    list.push_back({o.recording->id, fit.coefficient[0] / all.constant("gear_ratio")});
  }
  return list;
}

SanityFinding of_slope(const ObservedSet& all, const std::string& recording, double factor) {
  const double ratio = all.constant("gear_ratio");
  const std::string seen =
      fmt::format("the motor's angle is {:.4g} times the load's, and gear_ratio is {:.4g}",
                  factor * ratio, ratio);
  if (factor < 0.0) return kBackwards.on(recording, seen);
  const std::string mistake = mistake_of(factor, ratio);
  return kOtherRatio.on(
      recording,
      mistake.empty() ? seen : fmt::format("{} ({:.3g} times it: {})", seen, factor, mistake));
}

std::vector<SanityFinding> find(const ObservedSet& all) {
  std::vector<SanityFinding> list;
  const double ratio = all.constant("gear_ratio");
  if (std::abs(ratio) < 1.0 || ratio < 0.0) {
    list.push_back(
        (ratio < 0.0 ? kNegative : kNoReduction)
            .on("", fmt::format("gear_ratio is {:.4g}: a reduction is at least 1", ratio)));
  }
  if (all.set.rig != Rig::free || !std::isfinite(ratio)) return list;
  const auto factors = slopes(all);
  if (factors.empty()) return list;
  const Agreement agreement = agreement_of(factors, kMostOff);
  if (is_off(agreement.common, kMostOff)) list.push_back(of_slope(all, "", agreement.common));
  for (const Factor& other : agreement.others) {
    if (is_mistaken_alone(other.value, kMostOff)) {
      list.push_back(of_slope(all, other.recording, other.value));
    }
  }
  return list;
}

}  // namespace

SanityRow describe_gear_ratio() {
  return {"gear_ratio",
          "the gear ratio against what the two angles say",
          {kNegative, kNoReduction, kBackwards, kOtherRatio},
          find};
}

}  // namespace flexspline::data
