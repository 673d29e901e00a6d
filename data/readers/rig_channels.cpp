#include "readers/rig_channels.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "flexspline/core/error.hpp"
#include "flexspline/data/rig_channels.hpp"

namespace flexspline::data {
namespace {

using Channels = std::vector<Channel>;

const Channel* find(const Channels& channels, Quantity quantity) {
  const auto found = std::ranges::find(channels, quantity, &Channel::quantity);
  return found == channels.end() ? nullptr : &*found;
}

bool has(const Channels& channels, Quantity quantity) {
  return find(channels, quantity) != nullptr;
}

bool has_all(const Channels& channels, const std::vector<Quantity>& wanted) {
  return std::ranges::all_of(wanted, [&](Quantity one) { return has(channels, one); });
}

std::optional<std::string> complaint(Rig rig, const ChannelChoice& choice,
                                     const Channels& channels) {
  const auto count = std::ranges::count_if(
      choice.alternatives, [&](const auto& together) { return has_all(channels, together); });
  if (count == 1 || (count > 1 && !choice.exactly_one)) return std::nullopt;
  if (choice.alternatives.size() == 1) {
    return fmt::format("no channel is the {}, which rig '{}' needs", words_of(choice),
                       name_of(rig));
  }
  if (choice.exactly_one) {
    return fmt::format("rig '{}' needs exactly one channel out of {}; there are {}", name_of(rig),
                       words_of(choice), count);
  }
  return fmt::format("rig '{}' needs what drives it: {}", name_of(rig), words_of(choice));
}

std::optional<std::string> velocity_complaint(const Channels& channels) {
  const Channel* rate = find(channels, Quantity::velocity);
  if (rate == nullptr) return std::nullopt;
  const bool linear = has(channels, Quantity::displacement);
  if ((rate->unit.dimension == Dimension::velocity) == linear) return std::nullopt;
  return fmt::format("column '{}' is a velocity in {}, but the motion is {}", rate->column,
                     rate->unit.symbol, linear ? "linear" : "angular");
}

}  // namespace

std::string words_of(const ChannelChoice& choice) {
  std::string words;
  for (const auto& together : choice.alternatives) {
    words += words.empty() ? "" : choice.exactly_one ? ", " : ", or ";
    for (std::size_t i = 0; i < together.size(); ++i) {
      words += fmt::format("{}{}", i > 0 ? " with " : "", name_of(together[i]));
    }
  }
  return words;
}

std::span<const RigChannels> rig_channels() {
  using enum Quantity;
  static const std::vector<RigChannels> rows = {
      {Rig::locked,
       {{{{motor_angle}}}, {{{transmitted_torque}}}},
       {motor_torque, load_angle, velocity, commanded_angle, current, temperature, valid},
       {motor_angle, transmitted_torque}},
      {Rig::free,
       {{{{motor_angle}}}, {{{load_angle}}}, {{{motor_torque}}}},
       {transmitted_torque, velocity, commanded_angle, current, temperature, valid},
       {motor_angle, load_angle, transmitted_torque}},
      {Rig::specimen,
       {{{{torsion}, {angle}, {displacement}}, true},
        {{{transmitted_torque}, {torque}, {force}}, true}},
       {velocity, commanded_torque, temperature, valid},
       {torsion, angle, displacement, transmitted_torque, torque, force}},
      {Rig::servo,
       {{{{load_angle}}}, {{{motor_torque}, {current}, {duty_cycle, supply_voltage}}}},
       {drive_enabled, commanded_angle, velocity, temperature, valid},
       {load_angle}},
  };
  return rows;
}

const RigChannels& rig_channels(Rig rig) {
  const auto found = std::ranges::find(rig_channels(), rig, &RigChannels::rig);
  expects(found != rig_channels().end(), "every rig has a row of channels");
  return *found;
}

std::vector<std::string> rig_complaints(Rig rig, const Channels& channels) {
  std::vector<std::string> complaints;
  std::vector<ChannelChoice> needs = {{{{Quantity::time}}}};
  std::ranges::copy(rig_channels(rig).needs, std::back_inserter(needs));
  for (const ChannelChoice& choice : needs) {
    if (auto one = complaint(rig, choice, channels)) complaints.push_back(*std::move(one));
  }
  if (rig != Rig::specimen) return complaints;
  if (auto one = velocity_complaint(channels)) complaints.push_back(*std::move(one));
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
    const Channel* motion = find(channels, quantity);
    if (motion == nullptr) continue;
    // Counts mean nothing without their encoder.
    units.motion = motion->unit.symbol == kCounts ? "deg" : motion->unit.symbol;
  }
  return units;
}

}  // namespace flexspline::data
