#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sanity/check.hpp"
#include "sanity/evidence.hpp"

namespace flexspline::data {
namespace {

using Eigen::ArrayXd;

constexpr SanityVerdict kBackwards{"check_sign", Severity::error,
                                   "check the sign of motor_torque against transmitted_torque"};
constexpr std::string_view kScale =
    "check the units of both torques, gear_ratio, and which column is which";
constexpr SanityVerdict kOtherRatio{"check_ratio", Severity::error, kScale};
constexpr SanityVerdict kOtherUnits{"check_units", Severity::error, kScale};

constexpr double kMostOff = 1.8;
constexpr double kLoaded =
    0.3;  // of the largest range of torque: below it noise flattens the slope
constexpr double kClear = 20.0;  // standard errors, of white noise

/// The motor torque over J theta'' + tau/N, or what is beside J theta'' over tau/N, whichever is
/// nearer to 1. A motor that turns mostly its own inertia makes a small error of its torque a large
/// one of tau's; an angle that ripples makes its acceleration a column of errors, which flatten the
/// slope over the sum. A mistaken unit or ratio shows in both.
Regression slope_of(const Observed& o, double ratio, double inertia) {
  const ArrayXd transmitted = o.effort / ratio;
  const ArrayXd turning = inertia * o.motor_acceleration;
  const auto beside_friction = [&](const ArrayXd& column, const ArrayXd& torque) {
    return regression(
        {column, o.motor_speed, smooth_sign(o.motor_speed), ArrayXd::Ones(o.time.size())}, torque,
        o.usable);
  };
  const ArrayXd rest = o.drive - turning;
  return nearer_to(1.0, beside_friction(transmitted, rest),
                   beside_friction(turning + transmitted, o.drive));
}

/// Slope of the motor torque over tau/N beside inertia and frictions: 1, but for the losses. The
/// inertia is free only where it is not stated: a load's is much like it.
std::vector<Factor> slopes(const ObservedSet& all) {
  const double ratio = all.constant("gear_ratio");
  const double inertia = all.constant("motor_inertia_kgm2");
  std::vector<Factor> list;
  double widest = 0.0;
  for (const Observed& o : all.recordings) widest = std::max(widest, range_of(o.effort));
  for (const Observed& o : all.recordings) {
    if (range_of(o.effort) < kLoaded * widest) continue;
    if (o.effort.size() == 0 || o.motor_angle.size() == 0) continue;
    if (o.drive.size() == 0 || o.recording->find(Quantity::motor_torque) == nullptr) continue;
    const auto fit = inertia > 0.0
                         ? slope_of(o, ratio, inertia)
                         : regression({o.effort / ratio, o.motor_speed, smooth_sign(o.motor_speed),
                                       ArrayXd::Ones(o.time.size()), o.motor_acceleration},
                                      o.drive, o.usable);
    if (std::abs(fit.coefficient[0]) < kClear * fit.error[0]) continue;
    list.push_back({o.recording->id, fit.coefficient[0]});
  }
  return list;
}

SanityFinding finding(const std::string& recording, double factor, double ratio) {
  const std::string seen =
      fmt::format("motor_torque changes by {:.3g} of transmitted_torque/gear_ratio", factor);
  if (factor < 0.0) return kBackwards.on(recording, seen);
  const std::string mistake = mistake_of(factor, ratio);
  const bool of_ratio = !is_off(factor, 4.0);
  return (of_ratio ? kOtherRatio : kOtherUnits)
      .on(recording, mistake.empty() ? seen : fmt::format("{} ({})", seen, mistake));
}

std::vector<SanityFinding> find(const ObservedSet& all) {
  const double ratio = all.constant("gear_ratio");
  if (all.set.rig == Rig::servo || !std::isfinite(ratio)) return {};
  const auto factors = slopes(all);
  if (factors.empty()) return {};
  const Agreement agreement = agreement_of(factors, kMostOff);
  std::vector<SanityFinding> list;
  if (is_off(agreement.common, kMostOff)) list.push_back(finding("", agreement.common, ratio));
  for (const Factor& other : agreement.others) {
    if (is_mistaken_alone(other.value, kMostOff)) {
      list.push_back(finding(other.recording, other.value, ratio));
    }
  }
  return list;
}

}  // namespace

SanityRow describe_motor_torque() {
  return {"motor_torque",
          "the motor's torque against the transmitted torque over the ratio",
          {kBackwards, kOtherRatio, kOtherUnits},
          find};
}

}  // namespace flexspline::data
