#include <algorithm>

#include <fmt/format.h>

#include "flexspline/core/rig_residuals.hpp"
#include "signals/smoothing.hpp"

namespace flexspline {
namespace {

using Series = std::vector<double>;

struct Smoothed {
  Series& value;
  Series& rate;
  Series& second;

  void fill(const Recording& recording, const Series& samples) const {
    SmoothSignal smooth = smooth_by_spline(recording.time, samples);
    value = std::move(smooth.value);
    rate = std::move(smooth.rate);
    second = std::move(smooth.second);
  }
};

const Series* first_of(const Recording& recording, std::initializer_list<Quantity> candidates) {
  for (const Quantity quantity : candidates) {
    if (const Series* found = recording.find(quantity)) return found;
  }
  return nullptr;
}

// A servo's motor follows its rigid load, and its winding the voltage at once.
Series motor_torque_of(const DriveSpec& drive, const Recording& recording,
                       const DriveChannels& channels) {
  Series torque;
  const Series* duty = recording.find(Quantity::duty_cycle);
  const Series* supply = recording.find(Quantity::supply_voltage);
  if (const Series* direct = recording.find(Quantity::motor_torque)) {
    torque = *direct;
  } else if (const Series* current = recording.find(Quantity::current)) {
    for (double i : *current) torque.push_back(drive.torque_constant * i);
  } else if (duty != nullptr && supply != nullptr && !channels.motor_speed.empty()) {
    for (std::size_t i = 0; i < duty->size(); ++i) {
      const double volts = (*duty)[i] * (*supply)[i] - drive.back_emf * channels.motor_speed[i];
      torque.push_back(drive.torque_constant * volts / drive.resistance);
    }
  }
  const Series* enabled = recording.find(Quantity::drive_enabled);
  for (std::size_t i = 0; enabled != nullptr && i < torque.size(); ++i) {
    if ((*enabled)[i] < 0.5) torque[i] = 0.0;
  }
  return torque;
}

void follow_rigidly(double ratio, const Series& load, Series& motor) {
  motor.resize(load.size());
  std::ranges::transform(load, motor.begin(), [&](double x) { return ratio * x; });
}

}  // namespace

Result<DriveChannels> drive_channels(Rig rig, const DriveSpec& drive, const Recording& recording) {
  if (recording.time.size() < 16) {
    return failure(ErrorCode::numerics,
                   fmt::format("recording {} has {} samples", recording.id, recording.time.size()),
                   "derivatives need 16 or more");
  }
  DriveChannels c;
  c.time = recording.time;
  if (const Series* motor = recording.find(Quantity::motor_angle)) {
    Smoothed{c.motor_angle, c.motor_speed, c.motor_acceleration}.fill(recording, *motor);
  }
  if (const Series* load = recording.find(Quantity::load_angle)) {
    Smoothed{c.load_angle, c.load_speed, c.load_acceleration}.fill(recording, *load);
  }
  if (rig == Rig::specimen) {
    const Series* motion =
        first_of(recording, {Quantity::torsion, Quantity::displacement, Quantity::angle});
    if (motion != nullptr) {
      Smoothed{c.torsion, c.torsion_rate, c.torsion_acceleration}.fill(recording, *motion);
    }
  }
  if (rig == Rig::servo && c.motor_angle.empty()) {
    follow_rigidly(drive.gear_ratio, c.load_angle, c.motor_angle);
    follow_rigidly(drive.gear_ratio, c.load_speed, c.motor_speed);
    follow_rigidly(drive.gear_ratio, c.load_acceleration, c.motor_acceleration);
  }
  const Series* effort =
      first_of(recording, {Quantity::transmitted_torque, Quantity::torque, Quantity::force});
  if (effort != nullptr) c.transmitted_torque = *effort;
  c.motor_torque = motor_torque_of(drive, recording, c);
  return c;
}

}  // namespace flexspline
