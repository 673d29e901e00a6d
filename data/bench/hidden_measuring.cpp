#include "bench/hidden_measuring.hpp"

#include <algorithm>
#include <cmath>

#include "bench/counter_noise.hpp"
#include "bench/hidden_differences.hpp"
#include "bench/hidden_draw.hpp"

namespace flexspline::data {
namespace {

// Far from the streams of the paper's bench.
enum Stream : std::uint64_t { jitter_stream = 40, torque_stream, motor_torque_stream = 50 };

/// Instants in samples: the first at 0, the others off by a share of the interval.
std::vector<double> instants(const HiddenBench& bench, const HiddenSession& session) {
  const CounterNoise noise(bench.seed, session.id, jitter_stream);
  std::vector<double> at;
  for (int k = 0; k < session.excitation.samples; ++k) {
    const double by = bench.nuisances.time_jitter * noise.normal(static_cast<std::uint64_t>(k));
    at.push_back(k + (k == 0 ? 0.0 : std::clamp(by, -0.4, 0.4)));
  }
  return at;
}

std::vector<double> sampled(const std::vector<double>& values, const std::vector<double>& at) {
  std::vector<double> samples;
  for (const double instant : at) samples.push_back(between(values, kStepsPerSample * instant));
  return samples;
}

/// White noise of variance 1: normal, or of Student's t as a normal over the root of a chi square.
class White {
 public:
  White(const HiddenBench& bench, const std::string& id, std::uint64_t stream)
      : normal_(bench.seed, id, stream),
        squares_(bench.seed, id, stream + 2),
        degrees_(static_cast<std::uint64_t>(bench.nuisances.tail_degrees)) {}

  double operator()(std::uint64_t k) const {
    if (degrees_ == 0) return normal_.normal(k);
    double chi_square = 0.0;
    for (std::uint64_t j = 0; j < degrees_; ++j) {
      chi_square += std::pow(squares_.normal(degrees_ * k + j), 2);
    }
    const double scale = static_cast<double>(degrees_) - 2.0;  // the variance of t is n / (n - 2)
    return normal_.normal(k) * std::sqrt(scale / chi_square);
  }

 private:
  CounterNoise normal_;
  CounterNoise squares_;
  std::uint64_t degrees_;
};

void add_noise(std::vector<double>& values, double rms, const HiddenBench& bench,
               const std::string& id, std::uint64_t stream) {
  const White white(bench, id, stream);
  const CounterNoise fresh(bench.seed, id, stream + 1);
  const double share = bench.nuisances.coloured_share;
  const double memory = std::exp(-1.0 / bench.nuisances.coloured_samples);
  double slow = fresh.normal(0);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k > 0) slow = memory * slow + std::sqrt(1.0 - memory * memory) * fresh.normal(k);
    values[k] += rms * (std::sqrt(1.0 - share) * white(k) + std::sqrt(share) * slow);
  }
}

void encode(std::vector<double>& values, double zero, double step) {
  for (double& value : values) {
    value += zero;
    if (step > 0.0) value = std::round(value / step) * step;
  }
}

void low_pass(std::vector<double>& values, double step_over_time) {
  const double keeps = std::exp(-step_over_time);
  const double slope_share = (1.0 - keeps) / step_over_time;
  double last = values.front();
  for (std::size_t k = 1; k < values.size(); ++k) {
    const double now = values[k];
    values[k] = keeps * values[k - 1] + (1.0 - slope_share) * now + (slope_share - keeps) * last;
    last = now;
  }
}

}  // namespace

HiddenSignals filtered(HiddenSignals signals, double samples) {
  if (samples == 0.0) return signals;
  for (auto* channel :
       {&signals.motor_angle, &signals.load_angle, &signals.torque, &signals.motor_torque}) {
    low_pass(*channel, 1.0 / (kStepsPerSample * samples));
  }
  return signals;
}

Recording ideal_recording(const HiddenBench& bench, const HiddenSession& session,
                          const HiddenSignals& signals) {
  const std::vector<double> at = instants(bench, session);
  Recording r;
  r.id = session.id;
  r.excitation = name_of(session.excitation.motion);
  r.amplitude = session.excitation.amplitude;
  r.frequency_hz = session.excitation.frequency_hz;
  r.start_s = session.start_s;
  for (const double instant : at) r.time.push_back(instant * session.interval());
  if (bench.rig == Rig::specimen) {
    std::vector<double>& motion = r.channels[bench.travels ? Quantity::angle : Quantity::torsion];
    motion = sampled(signals.motor_angle, at);
    for (double& value : motion) value /= bench.gear.gear_ratio;
  } else {
    r.channels[Quantity::motor_torque] = sampled(signals.motor_torque, at);
  }
  if (bench.rig == Rig::locked || bench.rig == Rig::free) {
    r.channels[Quantity::motor_angle] = sampled(signals.motor_angle, at);
  }
  if (bench.rig == Rig::free || bench.rig == Rig::servo) {
    r.channels[Quantity::load_angle] = sampled(signals.load_angle, at);
  }
  if (bench.rig != Rig::servo) {
    r.channels[Quantity::transmitted_torque] = sampled(signals.torque, at);
  }
  return r;
}

Recording noisy_recording(const HiddenBench& bench, Recording ideal, double torque_noise,
                          double motor_torque_noise) {
  const HiddenNuisances& n = bench.nuisances;
  const double own_zero = n.zero_spread * drawn(bench.seed, ideal.id, 1002, -1.0, 1.0);
  const double turns = bench.rig == Rig::specimen ? 1.0 : bench.gear.gear_ratio;
  const double zero = (n.angle_zero + own_zero) * turns;
  for (auto& [quantity, values] : ideal.channels) {
    switch (quantity) {
      case Quantity::motor_angle:
      case Quantity::torsion:
      case Quantity::angle:
        encode(values, zero, n.motor_encoder_step);
        break;
      case Quantity::load_angle:
        encode(values, n.load_zero, n.load_encoder_step);
        break;
      case Quantity::transmitted_torque:
        add_noise(values, torque_noise, bench, ideal.id, torque_stream);
        for (double& value : values) value += n.torque_offset * torque_noise;
        break;
      case Quantity::motor_torque:
        add_noise(values, motor_torque_noise, bench, ideal.id, motor_torque_stream);
        for (double& value : values) value += n.motor_torque_offset * motor_torque_noise;
        break;
      default:
        break;
    }
  }
  return ideal;
}

}  // namespace flexspline::data
