#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/hidden_differences.hpp"
#include "bench/hidden_draw.hpp"
#include "bench/hidden_size.hpp"

namespace flexspline::data {
namespace {

void raise(double& peak, const std::vector<double>& values) {
  for (const double value : values) peak = std::max(peak, std::abs(value));
}

void raise_motion(HiddenScale& scale, const std::vector<double>& held, double step) {
  raise(scale.motion, held);
  raise(scale.speed, slopes(held, step));
  raise(scale.acceleration, bends(held, step));
}

void raise_all(HiddenScale& scale, const HiddenSignals& s, double ratio) {
  std::vector<double> torsion = s.motor_angle;
  for (std::size_t k = 0; k < torsion.size(); ++k)
    torsion[k] = torsion[k] / ratio - s.load_angle[k];
  const bool moves_load = scale.rig == Rig::free || scale.rig == Rig::servo;
  raise_motion(scale, moves_load ? s.load_angle : torsion, s.step);
  raise(scale.torsion, torsion);
  raise(scale.torque, s.torque);
  raise(scale.torque_rate, slopes(s.torque, s.step));
  raise(scale.motor_torque, s.motor_torque);
  raise(scale.motor_torque_rate, slopes(s.motor_torque, s.step));
  raise(scale.motor_speed, slopes(s.motor_angle, s.step));
}

}  // namespace

double HiddenScale::draw(std::string_view id, std::uint64_t index, double low, double high) const {
  return drawn(seed, id, index, low, high);
}

HiddenScale measure_scale(const HiddenBench& bench, const std::vector<HiddenSession>& sessions,
                          const std::vector<HiddenSignals>& null_runs) {
  HiddenScale scale;
  scale.rig = bench.rig;
  scale.travels = bench.travels;
  scale.gear = &bench.gear;
  scale.seed = bench.seed;
  // Summed in the order of size: the same bits whatever the order of the design.
  std::vector<double> rates;
  for (std::size_t k = 0; k < sessions.size(); ++k) {
    raise_all(scale, null_runs[k], bench.gear.gear_ratio);
    rates.push_back(std::log(2.0 * std::numbers::pi * sessions[k].excitation.frequency_hz));
    scale.clock_end = std::max(scale.clock_end, sessions[k].start_s + sessions[k].duration());
    scale.recordings.push_back({sessions[k].id, sessions[k].start_s, sessions[k].duration()});
  }
  std::ranges::sort(scale.recordings, {}, &HiddenScale::Span::id);
  std::ranges::sort(rates);
  double sum = 0.0;
  for (const double rate : rates) sum += rate;
  scale.mean_rate = std::exp(sum / static_cast<double>(rates.size()));
  return scale;
}

}  // namespace flexspline::data
