#include "flexspline/core/rig.hpp"

#include <algorithm>
#include <cmath>

#include "flexspline/core/effect_path.hpp"
#include "flexspline/core/monotone_input.hpp"
#include "flexspline/core/spline.hpp"
#include "rigs/rig_parts.hpp"

namespace flexspline {
namespace {

double channel_of(Rig rig, const Instant<double>& x, Quantity quantity) {
  switch (quantity) {
    case Quantity::time:
      return x.time;
    case Quantity::motor_angle:
      return x.motor_angle;
    case Quantity::load_angle:
      return x.load_angle;
    case Quantity::torsion:  // a specimen's motion is that of both shafts
      return rig == Rig::specimen ? x.motor_angle : x.motor_angle / x.gear_ratio - x.load_angle;
    case Quantity::velocity:
      return x.load_speed;
    case Quantity::transmitted_torque:
      return x.transmitted_torque;
    case Quantity::motor_torque:
      return x.motor_torque;
    default:
      return std::nan("");
  }
}

/// The site at which instruments' effects enter a channel.
std::optional<Site> site_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::transmitted_torque:
      return Site::torque_signal;
    case Quantity::motor_torque:
      return Site::motor_torque_signal;
    case Quantity::motor_angle:
      return Site::motor_angle_signal;
    case Quantity::load_angle:
      return Site::load_angle_signal;
    default:
      return std::nullopt;
  }
}

Result<void> apply_instruments(const ModelSpec& model, Quantity quantity,
                               std::span<const Instant<double>> path, std::span<double> signal) {
  const auto site = site_of(quantity);
  if (!site) return {};
  for (const EffectSpec& spec : model.effects) {
    const auto row = find_effect(spec.effect);
    if (!row) return tl::unexpected(row.error());
    if ((*row)->site != *site) continue;
    if (auto done = apply_along(**row, spec, path, signal); !done) return done;
  }
  return {};
}

double constant_named(const DriveSpec& drive, std::string_view name) {
  if (name == "gear_ratio") return drive.gear_ratio;
  const auto constants = drive_constants();
  const auto found = std::ranges::find(constants, name, &DriveConstant::name);
  expects(found != constants.end(), "a constant that a rig checks exists");
  return drive.*found->member;
}

}  // namespace

Signal sampled_signal(std::span<const double> time, std::span<const double> samples) {
  if (const auto input = MonotoneInput::through(time, samples)) {
    return {[input = *input](double t) { return input.value(t); },
            [input = *input](double t) { return input.slope(t); }};
  }
  const auto spline = std::make_shared<Spline>(time, samples);
  return {[spline](double t) { return spline->value(t); },
          [spline](double t) { return spline->slope(t); }};
}

std::vector<double> RigSystem::parameter_vector() const {
  std::vector<double> values;
  for (const DriveParameter& one : parameter_list()) values.push_back(one.value);
  return values;
}

std::vector<double> RigSystem::rest() const { return std::vector<double>(states(), 0.0); }

const RigRow& rig_row(Rig rig) {
  const auto found = std::ranges::find(rigs(), rig, &RigRow::rig);
  expects(found != rigs().end(), "every rig has a row");
  return *found;
}

Result<const RigForm*> checked_form(const RigRow& row, const DriveSpec& drive,
                                    const RigInputs& inputs, std::string_view form,
                                    const std::vector<std::string_view>& positive) {
  const auto found =
      form.empty() ? row.forms.begin() : std::ranges::find(row.forms, form, &RigForm::id);
  if (found == row.forms.end()) {
    return failure(ErrorCode::bad_data, fmt::format("the {} rig has no form '{}'", row.id, form),
                   "flexspline list rigs names them");
  }
  for (Quantity quantity : found->inputs) {
    if (inputs.channels.contains(quantity)) continue;
    return failure(ErrorCode::input_missing,
                   fmt::format("the {} rig is given no {}", row.id, name_of(quantity)),
                   fmt::format("its form {} is driven by it", found->id));
  }
  for (std::string_view name : positive) {
    const double value = constant_named(drive, name);
    if (value > 0.0) continue;
    return failure(ErrorCode::bad_data, fmt::format("{} is {} on the {} rig", name, value, row.id),
                   fmt::format("its form {} divides by it: give a positive one", found->id));
  }
  return &*found;
}

Result<std::unique_ptr<RigSystem>> make_rig(Rig rig, const DriveSpec& drive,
                                            const RigInputs& inputs, std::string_view form) {
  return rig_row(rig).make(drive, inputs, form);
}

std::vector<Instant<double>> instants_along(const RigSystem& system, std::span<const double> p,
                                            std::span<const double> times,
                                            std::span<const double> states) {
  std::vector<Instant<double>> path;
  std::vector<double> torque;
  for (std::size_t i = 0; i < times.size(); ++i) {
    path.push_back(
        system.instant(times[i], states.subspan(i * system.states(), system.states()), p));
    torque.push_back(path.back().transmitted_torque);
  }
  set_torque(path, torque);
  return path;
}

Result<Recording> record_of(const RigRow& row, const RigSystem& system, std::span<const double> p,
                            std::span<const double> times, std::span<const double> states) {
  const auto path = instants_along(system, p, times, states);
  Recording recording;
  recording.time.assign(times.begin(), times.end());
  for (Quantity quantity : row.outputs) {
    std::vector<double> signal;
    for (const auto& x : path) signal.push_back(channel_of(row.rig, x, quantity));
    auto done = apply_instruments(system.drive().torsion, quantity, path, signal);
    if (!done) return tl::unexpected(done.error());
    recording.channels[quantity] = std::move(signal);
  }
  return recording;
}

}  // namespace flexspline
