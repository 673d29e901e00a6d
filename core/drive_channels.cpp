#include <algorithm>
#include <utility>

#include "flexspline/core/rig_residuals.hpp"
#include "signals/smoothing.hpp"

namespace flexspline {
namespace {

using Series = std::vector<double>;

struct Smoothed {
  Series& value;
  Series& rate;
  Series& second;
  double* bandwidth = nullptr;
  Series* value_error = nullptr;
  Series* rate_error = nullptr;
  Series* second_error = nullptr;
  std::vector<NarrowerSecond>* narrower = nullptr;

  Result<void> fill(const Recording& recording, const Series& samples, Resolution resolution,
                    std::span<const double> times) const {
    auto smooth = smooth_by_spline(recording.time, samples, resolution,
                                   narrower == nullptr ? std::span<const double>{} : times);
    if (!smooth) return tl::unexpected(in_context(smooth.error(), "recording " + recording.id));
    value = std::move(smooth->value);
    rate = std::move(smooth->rate);
    second = std::move(smooth->second);
    if (value_error != nullptr) *value_error = std::move(smooth->value_error);
    if (rate_error != nullptr) *rate_error = std::move(smooth->rate_error);
    if (second_error != nullptr) *second_error = std::move(smooth->second_error);
    if (bandwidth != nullptr) *bandwidth = smooth->bandwidth;
    if (narrower != nullptr) *narrower = std::move(smooth->narrower);
    return {};
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

// Angles with their derivatives, as far as they were recorded.
Result<void> smooth_motions(Rig rig, double ratio, const Recording& recording,
                            Resolution resolution, std::span<const double> times,
                            DriveChannels& c) {
  const Series* torsion =
      rig == Rig::specimen
          ? first_of(recording, {Quantity::torsion, Quantity::displacement, Quantity::angle})
          : nullptr;
  double load_bandwidth = c.motor_bandwidth;
  std::vector<NarrowerSecond> motor, load;
  const std::pair<const Series*, Smoothed> motions[] = {
      {recording.find(Quantity::motor_angle),
       {c.motor_angle, c.motor_speed, c.motor_acceleration, &c.motor_bandwidth,
        &c.motor_angle_error, &c.motor_speed_error, &c.motor_acceleration_error, &motor}},
      {recording.find(Quantity::load_angle),
       {c.load_angle, c.load_speed, c.load_acceleration, &load_bandwidth, nullptr, nullptr,
        &c.load_acceleration_error, &load}},
      {torsion,
       {c.torsion, c.torsion_rate, c.torsion_acceleration, nullptr, &c.torsion_error,
        &c.torsion_rate_error}}};
  for (const auto& [samples, smoothed] : motions) {
    if (samples == nullptr) continue;
    if (auto filled = smoothed.fill(recording, *samples, resolution, times); !filled) return filled;
  }
  c.narrower.resize(times.size());
  for (std::size_t k = 0; k < motor.size(); ++k) {
    c.narrower[k].motor = std::move(motor[k].second);
    c.narrower[k].motor_error = std::move(motor[k].error);
    c.narrower[k].motor_bandwidth = motor[k].bandwidth;
  }
  for (std::size_t k = 0; k < load.size(); ++k) {
    c.narrower[k].load = std::move(load[k].second);
    c.narrower[k].load_error = std::move(load[k].error);
    c.narrower[k].load_bandwidth = load[k].bandwidth;
  }
  if (rig == Rig::servo && c.motor_angle.empty()) {
    follow_rigidly(ratio, c.load_angle, c.motor_angle);
    follow_rigidly(ratio, c.load_speed, c.motor_speed);
    follow_rigidly(ratio, c.load_acceleration, c.motor_acceleration);
    follow_rigidly(ratio, c.load_acceleration_error, c.motor_acceleration_error);
    c.motor_bandwidth = load_bandwidth;
    for (DriveChannels::Narrower& one : c.narrower) {
      follow_rigidly(ratio, one.load, one.motor);
      follow_rigidly(ratio, one.load_error, one.motor_error);
      one.motor_bandwidth = one.load_bandwidth;
    }
  }
  return {};
}

}  // namespace

Result<DriveChannels> drive_channels(Rig rig, const DriveSpec& drive, const Recording& recording,
                                     Resolution resolution, std::span<const double> narrower) {
  DriveChannels c;
  c.time = recording.time;
  if (auto smooth = smooth_motions(rig, drive.gear_ratio, recording, resolution, narrower, c);
      !smooth) {
    return tl::unexpected(smooth.error());
  }
  const Series* effort =
      first_of(recording, {Quantity::transmitted_torque, Quantity::torque, Quantity::force});
  if (effort != nullptr) c.transmitted_torque = *effort;
  c.motor_torque = motor_torque_of(drive, recording, c);
  return c;
}

}  // namespace flexspline
