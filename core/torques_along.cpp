#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "flexspline/core/effect_path.hpp"
#include "flexspline/core/rig.hpp"
#include "flexspline/core/rig_residuals.hpp"
#include "flexspline/core/simulate_rig.hpp"

namespace flexspline {
namespace {

using Series = std::vector<double>;
using Path = std::vector<Instant<double>>;

Path path_of(const DriveSpec& drive, const DriveChannels& c) {
  Path path(c.time.size());
  const auto enter = [&](const Series& series, double Instant<double>::*member) {
    for (std::size_t i = 0; i < series.size(); ++i) path[i].*member = series[i];
  };
  using I = Instant<double>;
  enter(c.time, &I::time);
  enter(c.motor_angle, &I::motor_angle), enter(c.motor_speed, &I::motor_speed);
  enter(c.motor_acceleration, &I::motor_acceleration);
  enter(c.load_angle, &I::load_angle), enter(c.load_speed, &I::load_speed);
  enter(c.load_acceleration, &I::load_acceleration);
  enter(c.motor_torque, &I::motor_torque);
  for (I& x : path) {
    x.gear_ratio = drive.gear_ratio;
    x.torsion = x.motor_angle / x.gear_ratio - x.load_angle;
    x.torsion_rate = x.motor_speed / x.gear_ratio - x.load_speed;
    x.torsion_acceleration = x.motor_acceleration / x.gear_ratio - x.load_acceleration;
  }
  if (!c.transmitted_torque.empty()) set_torque(path, c.transmitted_torque);
  return path;
}

/// What the effects at an instrument add along a path.
Result<Series> added_at(Site site, const ModelSpec& model, const Path& path) {
  Series sum(path.size(), 0.0);
  for (const EffectSpec& spec : model.effects) {
    const auto row = find_effect(spec.effect);
    if (!row) return tl::unexpected(row.error());
    if ((*row)->site != site || (*row)->map != nullptr) continue;
    if (auto done = apply_along(**row, spec, path, sum); !done) return tl::unexpected(done.error());
  }
  return sum;
}

Series rate_of(const Series& time, const Series& x) {
  Series rate(x.size(), 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::size_t before = i > 0 ? i - 1 : 0;
    const std::size_t after = std::min(i + 1, x.size() - 1);
    if (after > before) rate[i] = (x[after] - x[before]) / (time[after] - time[before]);
  }
  return rate;
}

void subtract(Series& from, const Series& what) {
  for (std::size_t i = 0; i < from.size(); ++i) from[i] -= what[i];
}

// An angle as it was, for one as its encoder shows it, with both its rates.
Result<void> undo_encoder(Site site, const RigModel& model, DriveChannels& c) {
  const auto added = added_at(site, model.drive.torsion, path_of(model.drive, c));
  if (!added) return tl::unexpected(added.error());
  if (std::ranges::all_of(*added, [](double x) { return x == 0.0; })) return {};
  const bool motor = site == Site::motor_angle_signal;
  const Series rate = rate_of(c.time, *added);
  subtract(motor ? c.motor_angle : c.load_angle, *added);
  subtract(motor ? c.motor_speed : c.load_speed, rate);
  subtract(motor ? c.motor_acceleration : c.load_acceleration, rate_of(c.time, rate));
  return {};
}

/// A torque as the sensor at a site shows it.
Result<Series> as_read(Site site, const RigModel& model, const DriveChannels& c, Series torque) {
  Path path = path_of(model.drive, c);
  if (site == Site::torque_signal) set_torque(path, torque);
  for (const EffectSpec& spec : model.drive.torsion.effects) {
    const auto row = find_effect(spec.effect);
    if (!row) return tl::unexpected(row.error());
    if ((*row)->site != site) continue;
    if (auto done = apply_along(**row, spec, path, torque); !done) {
      return tl::unexpected(done.error());
    }
  }
  return torque;
}

// The transmitted torque behind what its sensor shows; a whole signal's lag stays.
Result<void> undo_torque_sensor(const RigModel& model, DriveChannels& c) {
  const Series read = c.transmitted_torque;
  for (int k = 0; k < 20 && !read.empty(); ++k) {
    const auto added = added_at(Site::torque_signal, model.drive.torsion, path_of(model.drive, c));
    if (!added) return tl::unexpected(added.error());
    c.transmitted_torque = read;
    subtract(c.transmitted_torque, *added);
  }
  return {};
}

/// What was measured less what an equation leaves.
Series predicted(Series measured, const EquationResidual& left) {
  subtract(measured, left.value);
  return measured;
}

/// 1 + e of torque_constant_error.
double true_over_recorded(const ModelSpec& model) {
  double gain = 1.0;
  for (const EffectSpec& one : model.effects) {
    if (one.effect == "torque_constant_error") gain += one.parameters.front().second;
  }
  return gain;
}

/// J2 theta_l'' + B2 theta_l' + m g l sin(theta_l): what a rigid transmission hands on.
Series torque_on_load(const DriveSpec& drive, const DriveChannels& c) {
  Series torque(c.time.size());
  for (std::size_t i = 0; i < torque.size(); ++i) {
    torque[i] = drive.load_inertia * c.load_acceleration[i] + drive.load_viscous * c.load_speed[i] +
                drive.load_mass * drive.gravity * drive.arm_length * std::sin(c.load_angle[i]);
  }
  return torque;
}

struct Along {
  const RigModel& model;
  DriveChannels channels;
  Recording result;

  Result<void> enter(Quantity quantity, Site site, Series torque) {
    auto read = as_read(site, model, channels, std::move(torque));
    if (!read) return tl::unexpected(read.error());
    result.channels[quantity] = std::move(*read);
    return {};
  }

  Result<void> transmission() {
    Series measured = channels.transmitted_torque;
    if (measured.empty()) channels.transmitted_torque.assign(channels.time.size(), 0.0);
    if (model.rig == Rig::servo) {
      if (measured.empty()) channels.transmitted_torque = torque_on_load(model.drive, channels);
      return {};
    }
    const auto left = residuals(model.rig, model.drive, channels);
    if (!left) return tl::unexpected(left.error());
    if (left->torsion.value.empty()) return {};
    Series torque = predicted(channels.transmitted_torque, left->torsion);
    if (measured.empty()) channels.transmitted_torque = torque;
    return enter(Quantity::transmitted_torque, Site::torque_signal, std::move(torque));
  }

  Result<void> motor() {
    if (channels.motor_torque.empty()) channels.motor_torque.assign(channels.time.size(), 0.0);
    const auto left = residuals(model.rig, model.drive, channels);
    if (!left) return tl::unexpected(left.error());
    const bool servo = model.rig == Rig::servo;
    EquationResidual own = servo ? left->drive : left->motor;
    if (servo) {
      for (double& x : own.value) x /= model.drive.gear_ratio;
    }
    if (own.value.empty()) return {};
    // true torque = (1 + e) recorded, and the recorded one is the result
    const double gain = true_over_recorded(model.drive.torsion);
    for (double& x : own.value) x /= gain;
    return enter(Quantity::motor_torque, Site::motor_torque_signal,
                 predicted(channels.motor_torque, own));
  }
};

Result<void> angles_there(const RigModel& model, const Recording& recording) {
  std::vector<Quantity> needed = {Quantity::motor_angle};
  if (model.rig == Rig::free) needed.push_back(Quantity::load_angle);
  if (model.rig == Rig::servo) needed = {Quantity::load_angle};
  for (Quantity one : needed) {
    if (recording.find(one) != nullptr) continue;
    return failure(ErrorCode::input_missing,
                   fmt::format("recording {} has no {}", recording.id, name_of(one)),
                   fmt::format("the torques of the {} rig follow from it", name_of(model.rig)));
  }
  return {};
}

}  // namespace

Result<Recording> torques_along(const RigModel& model, const Recording& recording) {
  if (model.rig == Rig::specimen) {
    return failure(ErrorCode::bad_data, "a specimen has no shafts", "use simulate_torque");
  }
  if (auto there = angles_there(model, recording); !there) return tl::unexpected(there.error());
  auto channels = drive_channels(model.rig, model.drive, recording, resolution_on(model.rig));
  if (!channels) return tl::unexpected(channels.error());
  Along along{model, std::move(*channels), recording};
  for (Site site : {Site::motor_angle_signal, Site::load_angle_signal}) {
    if (auto done = undo_encoder(site, model, along.channels); !done) {
      return tl::unexpected(done.error());
    }
  }
  if (auto done = undo_torque_sensor(model, along.channels); !done) {
    return tl::unexpected(done.error());
  }
  if (auto done = along.transmission(); !done) return tl::unexpected(done.error());
  if (auto done = along.motor(); !done) return tl::unexpected(done.error());
  return std::move(along.result);
}

}  // namespace flexspline
