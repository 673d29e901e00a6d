#include "posterior/folded_record.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

namespace flexspline::estimators {
namespace {

constexpr double kWholeSamples = 0.1;  // of a sample: a period that counts as whole
constexpr double kSameMotion = 2.0;    // noises: cycles that differ by less repeat
constexpr std::size_t kMostHarmonics = 40;
constexpr double kSignificance = 4.0;  // standard errors of a harmonic's amplitude
constexpr std::size_t kFewest = 16;    // samples a cycle
constexpr double kEdge = 2.0;          // widths of the smoother
constexpr double kSlow = 0.1;          // of the fastest: speeds that may be left out

// Samples a cycle, where the motion repeats in whole samples and nothing is masked.
std::optional<std::size_t> samples_per_cycle(const PreparedRecord& record) {
  const auto& steady = record.smooth.steady;
  const auto& time = record.record.time;
  if (!steady || record.rows.size() != steady->last - steady->first) return std::nullopt;
  const auto size = steady->last - steady->first;
  const double interval =
      (time[steady->last - 1] - time[steady->first]) / static_cast<double>(size - 1);
  const double samples = steady->period / interval;
  const auto whole = static_cast<std::size_t>(std::lround(samples));
  const bool repeats = std::abs(samples - static_cast<double>(whole)) < kWholeSamples;
  if (!repeats || whole < kFewest || size < 2 * whole) return std::nullopt;
  return whole;
}

// The mean over cycles at every phase, and what single samples differ from it by, rescaled for the
// share of them that the mean took.
struct MeanCycle {
  std::vector<double> mean, differences;
};

MeanCycle mean_cycle(std::span<const double> series, std::size_t samples) {
  MeanCycle cycle;
  cycle.mean.assign(samples, 0.0);
  for (std::size_t i = 0; i < series.size(); ++i) {
    const std::size_t phase = i % samples;
    const auto count = static_cast<double>((series.size() - phase - 1) / samples + 1);
    cycle.mean[phase] += series[i] / count;
  }
  const double cycles = static_cast<double>(series.size()) / static_cast<double>(samples);
  const double taken = std::sqrt(cycles / (cycles - 1.0));
  for (std::size_t i = 0; i < series.size(); ++i) {
    cycle.differences.push_back(taken * (series[i] - cycle.mean[i % samples]));
  }
  return cycle;
}

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double x : values) sum += x * x;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

// The motion by its significant harmonics, whose errors stay unknowns of the fit.
void follow_harmonics(const std::vector<double>& mean, double omega, double sigma,
                      FoldedRecord& cycle) {
  const std::size_t size = mean.size();
  cycle.position.assign(size, 0.0);
  cycle.velocity.assign(size, 0.0);
  cycle.acceleration.assign(size, 0.0);
  for (std::size_t k = 0; k <= std::min(kMostHarmonics, size / 6); ++k) {
    const auto angle = [&](std::size_t j) {
      return 2.0 * std::numbers::pi * static_cast<double>(k * j % size) / static_cast<double>(size);
    };
    double in_phase = 0.0;
    double quadrature = 0.0;
    for (std::size_t j = 0; j < size; ++j) {
      in_phase += mean[j] * std::cos(angle(j)) * (k > 0 ? 2.0 : 1.0) / static_cast<double>(size);
      quadrature += mean[j] * std::sin(angle(j)) * 2.0 / static_cast<double>(size);
    }
    if (k > 1 && std::hypot(in_phase, quadrature) < kSignificance * sigma) continue;
    const double w = static_cast<double>(k) * omega;
    for (std::size_t j = 0; j < size; ++j) {
      const double value = in_phase * std::cos(angle(j)) + quadrature * std::sin(angle(j));
      cycle.position[j] += value;
      cycle.velocity[j] += w * (quadrature * std::cos(angle(j)) - in_phase * std::sin(angle(j)));
      cycle.acceleration[j] -= w * w * value;
    }
    cycle.motion.push_back({w, k > 0 ? sigma : sigma / std::numbers::sqrt2});
  }
}

double speed_sigma(const std::vector<MotionError>& motion) {
  double variance = 0.0;
  for (const auto& error : motion) variance += std::pow(error.angular_frequency * error.sigma, 2);
  return std::sqrt(variance);
}

// What a smoother leaves of white noise: its share of the variance, the error of the speed, and how
// many samples at either end know their neighbours on one side alone.
struct Smoothing {
  double speed_sigma = 0.0;
  std::size_t edge = 0;
};

// One that leaves the share s2 passes frequencies up to w = pi s2 / interval; the error of the
// speed is that of the position by w / sqrt(3).
Smoothing smoothing_of(const PreparedRecord& record) {
  const auto& time = record.smooth.motion.time;
  if (!(record.smooth.motion_noise > 0.0)) return {};
  const double interval = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  const double error = rms(record.smooth.motion_error);
  const double share = std::min(1.0, std::pow(error / record.smooth.motion_noise, 2));
  const auto most = static_cast<double>(time.size()) / 10.0;
  // A Fourier series has no ends.
  const double edge = record.smooth.steady ? 0.0 : std::min(kEdge / share, most);
  return {error * std::numbers::pi * share / interval / std::numbers::sqrt3,
          static_cast<std::size_t>(edge)};
}

// Where the direction of motion is not known, nothing is learned of a law that may jump with it.
// The faster rows stay, however little is known of the speed.
void drop_reversals(FoldedRecord& cycle, double speed_sigma) {
  double fastest = 0.0;
  for (const double v : cycle.velocity) fastest = std::max(fastest, std::abs(v));
  const double slowest = std::min(kSignificance * speed_sigma, kSlow * fastest);
  std::size_t kept = 0;
  for (std::size_t j = 0; j < cycle.time.size(); ++j) {
    if (std::abs(cycle.velocity[j]) < slowest) continue;
    for (auto* channel :
         {&cycle.time, &cycle.position, &cycle.velocity, &cycle.acceleration, &cycle.torque}) {
      (*channel)[kept] = (*channel)[j];
    }
    ++kept;
  }
  for (auto* channel :
       {&cycle.time, &cycle.position, &cycle.velocity, &cycle.acceleration, &cycle.torque}) {
    channel->resize(kept);
  }
}

FoldedRecord one_by_one(const PreparedRecord& record) {
  FoldedRecord all;
  const auto& m = record.smooth.motion;
  const Smoothing smoothing = smoothing_of(record);
  const auto at_an_edge = [&](std::size_t i) {
    return i < smoothing.edge || i + smoothing.edge >= m.time.size();
  };
  const bool inner = !std::ranges::all_of(record.rows, at_an_edge);
  for (const std::size_t i : record.rows) {
    if (inner && at_an_edge(i)) continue;
    all.time.push_back(m.time[i]);
    all.position.push_back(m.position[i]);
    all.velocity.push_back(m.velocity[i]);
    all.acceleration.push_back(m.acceleration[i]);
    all.torque.push_back(record.record.effort[i]);
  }
  all.noise.sigma = record.effort_noise;
  all.motion_sigma = record.motion_sigma;
  all.speed_sigma = smoothing.speed_sigma;
  drop_reversals(all, all.speed_sigma);
  return all;
}

}  // namespace

ColouredNoise noise_of(const FoldedRecord& record, std::vector<double> residual) {
  std::vector<double> time = record.time;
  const double interval = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  for (std::size_t i = time.size(); i < residual.size(); ++i) {
    time.push_back(time.back() + interval);
  }
  const TimedSeries series{std::move(time), std::move(residual)};
  return estimate_noise({&series, 1});
}

FoldedRecord folded(const PreparedRecord& record) {
  const auto samples = samples_per_cycle(record);
  if (!samples) return one_by_one(record);
  const auto& steady = *record.smooth.steady;
  const auto part = [&](const std::vector<double>& whole) {
    return std::span<const double>(whole).subspan(steady.first, steady.last - steady.first);
  };
  const auto time = part(record.record.time);
  const MeanCycle motion = mean_cycle(part(record.record.motion), *samples);
  if (rms(motion.differences) > kSameMotion * record.motion_sigma) return one_by_one(record);
  FoldedRecord cycle;
  cycle.repeats = true;
  cycle.phase_zero = time.front();
  cycle.time.assign(time.begin(), time.begin() + static_cast<std::ptrdiff_t>(*samples));
  const auto size = static_cast<double>(time.size());
  const double cycles = size / static_cast<double>(*samples);
  const double interval = (time.back() - time.front()) / (size - 1.0);
  follow_harmonics(motion.mean, 2.0 * std::numbers::pi / (interval * static_cast<double>(*samples)),
                   record.motion_sigma * std::sqrt(2.0 / size), cycle);
  MeanCycle torque = mean_cycle(part(record.record.effort), *samples);
  cycle.torque = std::move(torque.mean);
  cycle.noise = noise_of(cycle, std::move(torque.differences));
  cycle.noise.sigma /= std::sqrt(cycles);
  drop_reversals(cycle, speed_sigma(cycle.motion));
  return cycle;
}

}  // namespace flexspline::estimators
