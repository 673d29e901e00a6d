#include <cmath>

#include <fmt/format.h>

#include "sanity/check.hpp"
#include "sanity/evidence.hpp"

namespace flexspline::data {
namespace {

using Eigen::ArrayXd;

constexpr double kMostOff = 1.8;
constexpr double kClear = 20.0;  // standard errors, of white noise

/// Slope of the motor torque over tau/N beside inertia and frictions: 1, but for the losses.
std::vector<Factor> slopes(const ObservedSet& all) {
  const double ratio = all.constant("gear_ratio");
  std::vector<Factor> list;
  for (const Observed& o : all.recordings) {
    if (o.effort.size() == 0 || o.motor_angle.size() == 0) continue;
    if (o.drive.size() == 0 || o.recording->find(Quantity::motor_torque) == nullptr) continue;
    const auto fit = regression({o.effort / ratio, o.motor_acceleration, o.motor_speed,
                                 smooth_sign(o.motor_speed), ArrayXd::Ones(o.time.size())},
                                o.drive, o.usable);
    if (std::abs(fit.coefficient[0]) < kClear * fit.error[0]) continue;
    list.push_back({o.recording->id, fit.coefficient[0]});
  }
  return list;
}

SanityFinding finding(const std::string& recording, double factor, double ratio) {
  const std::string seen =
      fmt::format("motor_torque changes by {:.3g} of transmitted_torque/gear_ratio", factor);
  if (factor < 0.0) {
    return {"check_sign", "",   Severity::error,
            recording,    seen, "check the sign of motor_torque against transmitted_torque"};
  }
  const std::string mistake = mistake_of(factor, ratio);
  const bool of_ratio = !is_off(factor, 4.0);
  return {of_ratio ? "check_ratio" : "check_units",
          "",
          Severity::error,
          recording,
          mistake.empty() ? seen : fmt::format("{} ({})", seen, mistake),
          "check the units of both torques, gear_ratio, and which column is which"};
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
    if (is_off(other.value, kMostOff)) {
      list.push_back(finding(other.recording, other.value, ratio));
    }
  }
  return list;
}

}  // namespace

SanityRow describe_motor_torque() {
  return {"motor_torque", "the motor's torque against the transmitted torque over the ratio", find};
}

}  // namespace flexspline::data
