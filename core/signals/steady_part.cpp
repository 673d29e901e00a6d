#include <algorithm>
#include <cmath>
#include <vector>

#include "flexspline/core/signals.hpp"
#include "flexspline/core/spline.hpp"

namespace flexspline {
namespace {

constexpr std::size_t kPhases = 200;
constexpr double kRepeats = 0.15;     // cycles that differ by more of their rms do not repeat
constexpr double kAsTheLast = 0.02;   // differences below this share of the rms are steady

std::vector<double> cycle_ending(const Spline& signal, double end, double period) {
  std::vector<double> cycle(kPhases);
  for (std::size_t k = 0; k < kPhases; ++k) {
    cycle[k] = signal.value(end - period * (1.0 - static_cast<double>(k) / kPhases));
  }
  return cycle;
}

double rms_about_mean(const std::vector<double>& cycle) {
  double mean = 0.0;
  for (double y : cycle) mean += y / static_cast<double>(cycle.size());
  double sum = 0.0;
  for (double y : cycle) sum += (y - mean) * (y - mean);
  return std::sqrt(sum / static_cast<double>(cycle.size()));
}

double rms_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

// Number of cycles before the end that repeat the last one, that one included.
int repeating_cycles(const Spline& signal, double end, double period, int available) {
  const auto last = cycle_ending(signal, end, period);
  const double rms = rms_about_mean(last);
  double allowed = 0.0;
  int cycles = 1;
  for (int k = 1; k < available; ++k) {
    const double difference = rms_difference(cycle_ending(signal, end - k * period, period), last);
    if (k == 1) {
      if (difference > kRepeats * rms) return 1;
      allowed = std::max(1.5 * difference, kAsTheLast * rms);
    }
    if (difference > allowed) break;
    ++cycles;
  }
  return cycles;
}

}  // namespace

std::optional<SteadyPart> find_steady_part(const TorsionRecord& record) {
  if (record.travels || record.time.size() < 16) return std::nullopt;
  const double end = record.time.back();
  const double span = end - record.time.front();
  auto sine = fit_sine(record.time, record.motion, record.frequency_hz);
  if (!(sine.frequency_hz > 0.0) || span * sine.frequency_hz < 1.999) return std::nullopt;

  const Spline motion(record.time, record.motion);
  const Spline effort(record.time, record.effort);
  const double period = 1.0 / sine.frequency_hz;
  const int available = static_cast<int>(span / period + 1e-3);
  const int cycles = std::min(repeating_cycles(motion, end, period, available),
                              repeating_cycles(effort, end, period, available));
  if (cycles < 2) return std::nullopt;

  SteadyPart steady{.period = period, .first = 0, .last = record.time.size(), .cycles = cycles};
  const double from = end - cycles * period;
  steady.first = static_cast<std::size_t>(
      std::lower_bound(record.time.begin(), record.time.end(), from + 1e-9 * period) -
      record.time.begin());
  // The run-up has biased the frequency: fit it again without.
  const std::span<const double> t(record.time);
  const std::span<const double> x(record.motion);
  const double again =
      fit_sine(t.subspan(steady.first), x.subspan(steady.first), sine.frequency_hz).frequency_hz;
  if (std::abs(again * period - 1.0) < 0.1) steady.period = 1.0 / again;
  return steady;
}

std::optional<LoopFigures> loop_figures(const TorsionRecord& record) {
  const auto steady = find_steady_part(record);
  if (!steady) return std::nullopt;
  const auto smooth = reconstruct(record);
  if (!smooth) return std::nullopt;
  const Spline motion(record.time, smooth->motion.position);
  const Spline effort(record.time, smooth->effort);
  const double end = record.time[steady->last - 1];
  const auto x = cycle_ending(motion, end, steady->period);
  const auto y = cycle_ending(effort, end, steady->period);

  LoopFigures figures;
  const auto [low, high] = std::ranges::minmax(x);
  const double middle = 0.5 * (low + high);
  double rising = 0.0;
  double falling = 0.0;
  int crossings = 0;
  for (std::size_t k = 0; k < kPhases; ++k) {
    const std::size_t next = (k + 1) % kPhases;
    figures.peak_effort = std::max(figures.peak_effort, std::abs(y[k]));
    figures.area += 0.5 * (y[k] + y[next]) * (x[next] - x[k]);
    if ((x[k] - middle) * (x[next] - middle) >= 0.0 || x[k] == x[next]) continue;
    const double u = (middle - x[k]) / (x[next] - x[k]);
    (x[next] > x[k] ? rising : falling) += y[k] + u * (y[next] - y[k]);
    ++crossings;
  }
  figures.half_height = crossings > 0 ? (rising - falling) / static_cast<double>(crossings) : 0.0;
  return figures;
}

}  // namespace flexspline
