#include <algorithm>

#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline {
namespace {

constexpr std::pair<Rig, std::string_view> kRigs[] = {
    {Rig::locked, "locked"},
    {Rig::free, "free"},
    {Rig::specimen, "specimen"},
    {Rig::servo, "servo"},
};

}  // namespace

std::span<const QuantityInfo> quantities() {
  using enum Quantity;
  static const std::vector<QuantityInfo> rows = {
      {Quantity::time, "time", {Dimension::time}},
      {motor_angle, "motor_angle", {Dimension::angle}},
      {load_angle, "load_angle", {Dimension::angle}},
      {torsion, "torsion", {Dimension::angle}},
      {angle, "angle", {Dimension::angle}},
      {displacement, "displacement", {Dimension::length}},
      {velocity, "velocity", {Dimension::angular_velocity, Dimension::velocity}},
      {transmitted_torque, "transmitted_torque", {Dimension::torque}},
      {torque, "torque", {Dimension::torque}},
      {force, "force", {Dimension::force}},
      {motor_torque, "motor_torque", {Dimension::torque}},
      {commanded_torque, "commanded_torque", {Dimension::torque}},
      {commanded_angle, "commanded_angle", {Dimension::angle}},
      {current, "current", {Dimension::current}},
      {duty_cycle, "duty_cycle", {Dimension::dimensionless}},
      {supply_voltage, "supply_voltage", {Dimension::voltage}},
      {drive_enabled, "drive_enabled", {Dimension::dimensionless}},
      {temperature, "temperature", {Dimension::temperature}},
      {valid, "valid", {Dimension::dimensionless}},
  };
  return rows;
}

std::string_view name_of(Quantity quantity) {
  const auto found = std::ranges::find(quantities(), quantity, &QuantityInfo::quantity);
  expects(found != quantities().end(), "every quantity has a row in quantities()");
  return found->name;
}

std::optional<Quantity> find_quantity(std::string_view name) {
  const auto found = std::ranges::find(quantities(), name, &QuantityInfo::name);
  if (found == quantities().end()) return std::nullopt;
  return found->quantity;
}

std::string_view name_of(Rig rig) {
  const auto* found = std::ranges::find(kRigs, rig, &std::pair<Rig, std::string_view>::first);
  expects(found != std::end(kRigs), "every rig has a name");
  return found->second;
}

std::optional<Rig> find_rig(std::string_view name) {
  const auto* found = std::ranges::find(kRigs, name, &std::pair<Rig, std::string_view>::second);
  if (found == std::end(kRigs)) return std::nullopt;
  return found->first;
}

}  // namespace flexspline
