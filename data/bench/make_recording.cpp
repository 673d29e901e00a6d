#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "bench/bench_sensors.hpp"
#include "bench/prescribed_motion.hpp"
#include "bench/refusals.hpp"
#include "bench/slip_elements.hpp"
#include "flexspline/data/bench.hpp"

namespace flexspline::data {
namespace {

int sample_count(const BenchExcitation& excitation) {
  return excitation.cycles * excitation.samples_per_cycle;
}

Motion sampled_motion(const PrescribedMotion& prescribed, const BenchExcitation& excitation) {
  Motion motion;
  const double rate = excitation.frequency_hz * excitation.samples_per_cycle;
  for (int k = 0; k < sample_count(excitation); ++k) {
    const MotionPoint point = prescribed.at(prescribed.instant(k, 0.0, 0.0));
    motion.time.push_back(k / rate);
    motion.position.push_back(point.position);
    motion.velocity.push_back(point.velocity);
    motion.acceleration.push_back(point.acceleration);
  }
  return motion;
}

/// f(phi) + g^-1(phi'/h(phi)) + J phi''.
double memoryless_torque(const BenchTruth& truth, const MotionPoint& point) {
  const double reduced_speed = point.velocity * std::exp(-truth.log_modulation(point.position));
  return truth.stiffness(point.position) + truth.damping(reduced_speed) +
         truth.inertia * point.acceleration;
}

/// What an ideal sensor shows: the torque of sensor_lag_s ago.
std::vector<double> sensed_torque(const BenchTruth& truth, const PrescribedMotion& prescribed,
                                  int samples) {
  const double late_s = truth.sensor_lag_s;
  std::vector<double> torque = slip_torque(truth.slip_elements, prescribed, samples, late_s);
  for (int k = 0; k < samples; ++k) {
    const MotionPoint point = prescribed.at(prescribed.instant(k, 0.0, late_s));
    torque[static_cast<std::size_t>(k)] += memoryless_torque(truth, point);
  }
  return torque;
}

Recording recording_of(const BenchRecording& made, const BenchExcitation& excitation,
                       const BenchSensors& sensors, std::uint64_t seed, std::string id) {
  Recording recording;
  recording.excitation = "sine";
  recording.amplitude = excitation.amplitude;
  recording.frequency_hz = excitation.frequency_hz;
  recording.time = measured_time(made.motion.time, sensors, seed, id);
  recording.channels[Quantity::motor_angle] =
      measured_motor_angle(made.motion.position, sensors, seed, id);
  recording.channels[Quantity::transmitted_torque] =
      measured_torque(made.torque, sensors, seed, id);
  recording.id = std::move(id);
  return recording;
}

void keep(std::vector<double>& list, const std::vector<bool>& kept) {
  std::size_t to = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (kept[k]) list[to++] = list[k];
  }
  list.resize(to);
}

/// Takes the missing samples out of the table, and out of what is known of them.
void drop_missing(BenchRecording& made, const std::vector<bool>& kept) {
  keep(made.measured.time, kept);
  for (auto& [quantity, channel] : made.measured.channels) keep(channel, kept);
  for (auto* list : {&made.motion.time, &made.motion.position, &made.motion.velocity,
                     &made.motion.acceleration, &made.torque}) {
    keep(*list, kept);
  }
}

}  // namespace

Result<BenchRecording> make_recording(const BenchTruth& truth, const BenchExcitation& excitation,
                                      const BenchSensors& sensors, std::uint64_t seed,
                                      std::string id) {
  if (auto error = refusal(truth, excitation, sensors)) {
    return tl::unexpected(in_context(std::move(*error), "recording " + id));
  }
  const PrescribedMotion prescribed(excitation, truth.harmonics);
  BenchRecording made;
  made.motion = sampled_motion(prescribed, excitation);
  made.torque = sensed_torque(truth, prescribed, sample_count(excitation));
  for (std::size_t k = 0; k < made.torque.size(); ++k) {
    if (std::isfinite(made.torque[k])) continue;
    return failure(ErrorCode::numerics,
                   fmt::format("recording {}: the truth gives {} Nm at {} s, {} rad", id,
                               made.torque[k], made.motion.time[k], made.motion.position[k]),
                   "choose an amplitude and a frequency at which the truth is finite");
  }
  made.measured = recording_of(made, excitation, sensors, seed, std::move(id));
  if (sensors.missing_samples > 0.0) {
    drop_missing(made, samples_kept(made.torque.size(), sensors, seed, made.measured.id));
  }
  return made;
}

}  // namespace flexspline::data
