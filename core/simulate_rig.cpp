#include "flexspline/core/simulate_rig.hpp"

#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "flexspline/core/rig.hpp"

namespace flexspline {
namespace {

using Series = std::vector<double>;

constexpr std::pair<std::string_view, double DriveSpec::*> kStated[] = {
    {"gear_ratio", &DriveSpec::gear_ratio},
    {"motor_inertia_kgm2", &DriveSpec::motor_inertia},
    {"load_inertia_kgm2", &DriveSpec::load_inertia},
    {"load_mass_kg", &DriveSpec::load_mass},
    {"arm_length_m", &DriveSpec::arm_length}};

struct Driven {
  std::string_view form;
  std::vector<Quantity> by;
};

std::vector<Driven> ways_to_drive(Rig rig) {
  using Q = Quantity;
  if (rig == Rig::free) return {{"motor_driven", {Q::motor_torque}}};
  if (rig == Rig::locked) return {{"inertial", {Q::motor_torque}}};
  if (rig == Rig::specimen) {
    return {{"force_driven", {Q::transmitted_torque}},
            {"force_driven", {Q::torque}},
            {"force_driven", {Q::force}}};
  }
  return {{"torque_driven", {Q::motor_torque}},
          {"current_driven", {Q::current}},
          {"voltage_driven", {Q::duty_cycle, Q::supply_voltage}}};
}

Result<Driven> way_to_drive(Rig rig, const Recording& recording) {
  const auto ways = ways_to_drive(rig);
  for (const Driven& way : ways) {
    bool there = true;
    for (Quantity one : way.by) there = there && recording.find(one) != nullptr;
    if (there) return way;
  }
  return failure(
      ErrorCode::input_missing,
      fmt::format("recording {} has nothing that drives the {} rig", recording.id, name_of(rig)),
      fmt::format("record {}, or simulate the torque along its motion",
                  name_of(ways.front().by.front())));
}

double first_of(const Recording& recording, Quantity quantity) {
  const Series* channel = recording.find(quantity);
  return channel == nullptr || channel->empty() ? 0.0 : channel->front();
}

double first_rate(const Recording& recording, Quantity quantity) {
  const Series* x = recording.find(quantity);
  if (x == nullptr || x->size() < 2) return 0.0;
  return ((*x)[1] - (*x)[0]) / (recording.time[1] - recording.time[0]);
}

// By the names of the rig's own states; memory starts empty.
Series first_states(const RigSystem& system, Rig rig, const Recording& recording) {
  Series y = system.rest();
  const auto variables = system.variables();
  for (std::size_t k = 0; k < variables.size(); ++k) {
    if (variables[k].name == "motor_angle") y[k] = first_of(recording, Quantity::motor_angle);
    if (variables[k].name == "load_angle") y[k] = first_of(recording, Quantity::load_angle);
    if (variables[k].name == "motor_speed") y[k] = first_rate(recording, Quantity::motor_angle);
    if (variables[k].name == "load_speed") y[k] = first_rate(recording, Quantity::load_angle);
    if (rig == Rig::specimen && variables[k].name == "motion") {
      for (Quantity one : {Quantity::torsion, Quantity::angle, Quantity::displacement}) {
        if (recording.find(one) != nullptr) y[k] = first_of(recording, one);
      }
    }
  }
  return y;
}

}  // namespace

DriveSpec stated_drive(const RecordingSet& set) {
  DriveSpec drive;
  for (const auto& [key, member] : kStated) {
    const auto found = set.constants.find(std::string(key));
    if (found != set.constants.end()) drive.*member = found->second;
  }
  return drive;
}

Result<Recording> motions_under(const RigModel& model, const Recording& recording,
                                const IntegratorSettings& settings) {
  const auto way = way_to_drive(model.rig, recording);
  if (!way) return tl::unexpected(way.error());
  RigInputs inputs;
  for (Quantity one : way->by) {
    inputs.channels[one] = sampled_signal(recording.time, *recording.find(one));
  }
  if (const Series* enabled = recording.find(Quantity::drive_enabled)) {
    inputs.channels[Quantity::drive_enabled] = sampled_signal(recording.time, *enabled);
  }
  const auto system = make_rig(model.rig, model.drive, inputs, way->form);
  if (!system) return tl::unexpected(system.error());
  const Series p = (*system)->parameter_vector();
  const auto run =
      integrate_system(**system, p, recording.time, first_states(**system, model.rig, recording),
                       {.relative_tolerance = settings.relative_tolerance,
                        .absolute_tolerance = {},
                        .max_steps = settings.max_steps});
  if (!run) return tl::unexpected(run.error());
  auto simulated = record_of(rig_row(model.rig), **system, p, recording.time, run->state);
  if (!simulated) return simulated;
  simulated->id = recording.id;
  simulated->split = recording.split;
  return simulated;
}

}  // namespace flexspline
