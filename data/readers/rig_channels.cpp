#include "readers/rig_channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

namespace flexspline::data {
namespace {

using Channels = std::vector<Channel>;
using Quantities = std::initializer_list<Quantity>;

const Channel* find(const Channels& channels, Quantity quantity) {
  const auto found = std::ranges::find(channels, quantity, &Channel::quantity);
  return found == channels.end() ? nullptr : &*found;
}

bool has(const Channels& channels, Quantity quantity) {
  return find(channels, quantity) != nullptr;
}

std::string joined(Quantities quantities) {
  std::string names;
  for (const Quantity quantity : quantities) {
    if (!names.empty()) names += ", ";
    names += name_of(quantity);
  }
  return names;
}

void require(Rig rig, const Channels& channels, Quantities wanted,
             std::vector<std::string>& complaints) {
  for (const Quantity quantity : wanted) {
    if (has(channels, quantity)) continue;
    complaints.push_back(
        fmt::format("no channel is the {}, which rig '{}' needs", name_of(quantity), name_of(rig)));
  }
}

void require_one(Rig rig, const Channels& channels, Quantities wanted,
                 std::vector<std::string>& complaints) {
  const auto count =
      std::ranges::count_if(wanted, [&](Quantity quantity) { return has(channels, quantity); });
  if (count == 1) return;
  complaints.push_back(fmt::format("rig '{}' needs exactly one channel out of {}; there are {}",
                                   name_of(rig), joined(wanted), count));
}

void complain_of_specimen(const Channels& channels, std::vector<std::string>& complaints) {
  using enum Quantity;
  require_one(Rig::specimen, channels, {torsion, angle, displacement}, complaints);
  require_one(Rig::specimen, channels, {transmitted_torque, torque, force}, complaints);
  const Channel* rate = find(channels, velocity);
  if (rate == nullptr) return;
  const bool linear = has(channels, displacement);
  if ((rate->unit.dimension == Dimension::velocity) == linear) return;
  complaints.push_back(fmt::format("column '{}' is a velocity in {}, but the motion is {}",
                                   rate->column, rate->unit.symbol, linear ? "linear" : "angular"));
}

void complain_of_servo(const Channels& channels, std::vector<std::string>& complaints) {
  using enum Quantity;
  require(Rig::servo, channels, {load_angle}, complaints);
  const bool voltage = has(channels, duty_cycle) && has(channels, supply_voltage);
  if (has(channels, motor_torque) || has(channels, current) || voltage) return;
  complaints.emplace_back(
      "rig 'servo' needs what drives it: motor_torque, or current, or duty_cycle with "
      "supply_voltage");
}

}  // namespace

std::vector<std::string> rig_complaints(Rig rig, const Channels& channels) {
  using enum Quantity;
  std::vector<std::string> complaints;
  require(rig, channels, {Quantity::time}, complaints);
  switch (rig) {
    case Rig::locked:
      require(rig, channels, {motor_angle, transmitted_torque}, complaints);
      break;
    case Rig::free:
      require(rig, channels, {motor_angle, load_angle, motor_torque}, complaints);
      break;
    case Rig::specimen:
      complain_of_specimen(channels, complaints);
      break;
    case Rig::servo:
      complain_of_servo(channels, complaints);
      break;
  }
  return complaints;
}

DisplayUnits display_units(Rig rig, const Channels& channels) {
  using enum Quantity;
  DisplayUnits units;
  for (const Quantity quantity : {transmitted_torque, torque, force}) {
    if (const Channel* effort = find(channels, quantity)) units.effort = effort->unit.symbol;
  }
  if (rig != Rig::specimen) return units;
  for (const Quantity quantity : {torsion, angle, displacement}) {
    if (const Channel* motion = find(channels, quantity)) units.motion = motion->unit.symbol;
  }
  return units;
}

}  // namespace flexspline::data
