#include "bench/bench_sensors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bench/counter_noise.hpp"
#include "bench/table_one.hpp"

namespace flexspline::data {
namespace {

enum Stream : std::uint64_t {
  angle_stream,
  white_stream,
  coloured_stream,
  jitter_stream,
  missing_stream
};

/// Unit variance from the first sample on; correlation exp(-k / samples).
void add_coloured(std::vector<double>& signal, double rms, double samples,
                  const CounterNoise& noise) {
  const double memory = std::exp(-1.0 / samples);
  const double fresh = std::sqrt(1.0 - memory * memory);
  double state = noise.normal(0);
  for (std::size_t k = 0; k < signal.size(); ++k) {
    if (k > 0) state = memory * state + fresh * noise.normal(k);
    signal[k] += rms * state;
  }
}

void add_white(std::vector<double>& signal, double rms, const CounterNoise& noise) {
  for (std::size_t k = 0; k < signal.size(); ++k) signal[k] += rms * noise.normal(k);
}

}  // namespace

std::vector<double> measured_motor_angle(const std::vector<double>& position,
                                         const BenchSensors& sensors, std::uint64_t seed,
                                         std::string_view id) {
  std::vector<double> angle = position;
  const double rms = sensors.angle_noise * kPaperAmplitude;
  if (rms > 0.0) add_white(angle, rms, {seed, id, angle_stream});
  const double step = sensors.encoder_step;
  for (double& value : angle) {
    value *= kPaperGearRatio;
    if (step > 0.0) value = std::round(value / step) * step;
  }
  return angle;
}

std::vector<double> measured_torque(const std::vector<double>& torque, const BenchSensors& sensors,
                                    std::uint64_t seed, std::string_view id) {
  std::vector<double> measured = torque;
  const double white = sensors.torque_noise_white * kPaperPeakTorque;
  const double coloured = sensors.torque_noise_coloured * kPaperPeakTorque;
  if (white > 0.0) add_white(measured, white, {seed, id, white_stream});
  if (coloured > 0.0) {
    add_coloured(measured, coloured, sensors.torque_noise_samples, {seed, id, coloured_stream});
  }
  return measured;
}

std::vector<double> measured_time(const std::vector<double>& time, const BenchSensors& sensors,
                                  std::uint64_t seed, std::string_view id) {
  constexpr double kLargest = 0.45;  // of a step, so that time goes on increasing
  std::vector<double> stamps = time;
  if (!(sensors.time_jitter > 0.0) || time.size() < 2) return stamps;
  const CounterNoise noise(seed, id, jitter_stream);
  const double step = time[1] - time[0];
  for (std::size_t k = 1; k < stamps.size(); ++k) {
    stamps[k] += step * std::clamp(sensors.time_jitter * noise.normal(k), -kLargest, kLargest);
  }
  return stamps;
}

std::vector<bool> samples_kept(std::size_t count, const BenchSensors& sensors, std::uint64_t seed,
                               std::string_view id) {
  std::vector<bool> kept(count, true);
  if (!(sensors.missing_samples > 0.0)) return kept;
  const CounterNoise noise(seed, id, missing_stream);
  for (std::size_t k = 1; k + 1 < count; ++k) {
    kept[k] = 0.5 * std::erfc(-noise.normal(k) / std::sqrt(2.0)) >= sensors.missing_samples;
  }
  return kept;
}

}  // namespace flexspline::data
