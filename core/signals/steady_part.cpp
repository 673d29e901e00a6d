#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "flexspline/core/signals.hpp"
#include "flexspline/core/spline.hpp"

namespace flexspline {
namespace {

constexpr std::size_t kPhases = 200;
constexpr double kRepeats = 0.15;    // cycles that differ by more of their rms do not repeat
constexpr double kAsTheBest = 0.02;  // differences below this share of the rms are steady
constexpr double kSliver = 0.02;     // of a period before the first cycle that still belongs to it
constexpr double kAtRest = 0.5;      // of the largest cycle's rms: smaller ones are no loop

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

// A run of cycles that agree, on the grid of half cycles before the end of the record: its last
// cycle ends at end - steps * period / 2.
struct Run {
  int steps = 0;
  int cycles = 0;
  double allowed = 0.0;
};

// Cycles as the signal has them, ending every half period before the end of the record.
class Cycles {
 public:
  Cycles(const Spline& signal, double end, double period, int available) {
    for (int k = 0; k <= 2 * (available - 1); ++k) {
      cycles_.push_back(cycle_ending(signal, end - 0.5 * k * period, period));
      largest_ = std::max(largest_, rms_about_mean(cycles_.back()));
    }
  }

  int steps() const { return static_cast<int>(cycles_.size()); }

  // Difference between the cycles `a` and `b`, in parts of the rms; infinite where either rests.
  double difference(int a, int b) const {
    const auto& one = cycles_[static_cast<std::size_t>(a)];
    const auto& other = cycles_[static_cast<std::size_t>(b)];
    const double rms = std::min(rms_about_mean(one), rms_about_mean(other));
    if (rms < kAtRest * largest_) return std::numeric_limits<double>::infinity();
    return rms_difference(one, other) / rms;
  }

 private:
  std::vector<std::vector<double>> cycles_;
  double largest_ = 0.0;
};

double pair_difference(const Cycles& motion, const Cycles& effort, int a, int b) {
  return std::max(motion.difference(a, b), effort.difference(a, b));
}

// The pair of neighbouring cycles that agree best, with every neighbour before and after that does.
std::optional<Run> longest_run(const Cycles& motion, const Cycles& effort) {
  int best = -1;
  double least = kRepeats;
  for (int k = 0; k + 2 < motion.steps(); ++k) {
    const double difference = pair_difference(motion, effort, k, k + 2);
    // A later pair is kept unless an earlier one is clearly better: transients come first.
    if (difference < (best < 0 ? least : 0.7 * least)) {
      least = difference;
      best = k;
    }
  }
  if (best < 0) return std::nullopt;
  Run run{.steps = best, .cycles = 2, .allowed = std::max(1.5 * least, kAsTheBest)};
  auto agrees = [&](int k) {
    return k >= 0 && k < motion.steps() && pair_difference(motion, effort, k, best) <= run.allowed;
  };
  while (agrees(run.steps - 2)) {
    run.steps -= 2;
    ++run.cycles;
  }
  while (agrees(run.steps + 2 * run.cycles)) ++run.cycles;
  return run;
}

std::size_t index_at(std::span<const double> time, double t) {
  return static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), t) - time.begin());
}

// The steady part by cycles of this period, with the period that the motion has there.
std::optional<SteadyPart> steady_by(const TorsionRecord& record, double period) {
  const double end = record.time.back();
  const double span = end - record.time.front();
  const int available = static_cast<int>(span / period + 1e-3);
  if (available < 2) return std::nullopt;
  const Cycles motion(Spline(record.time, record.motion), end, period, available);
  const Cycles effort(Spline(record.time, record.effort), end, period, available);
  const auto run = longest_run(motion, effort);
  if (!run) return std::nullopt;

  const double to = end - 0.5 * run->steps * period;
  const double from = to - run->cycles * period;
  SteadyPart steady{.period = period,
                    .first = index_at(record.time, from),
                    .last = index_at(record.time, to + 1e-9 * period),
                    .cycles = run->cycles};
  if (from - record.time.front() < kSliver * period) steady.first = 0;
  const std::size_t length = steady.last - steady.first;
  const double again =
      fit_sine(std::span(record.time).subspan(steady.first, length),
               std::span(record.motion).subspan(steady.first, length), 1.0 / period)
          .frequency_hz;
  if (std::abs(again * period - 1.0) < 0.1) steady.period = 1.0 / again;
  return steady;
}

}  // namespace

std::optional<SteadyPart> find_steady_part(const TorsionRecord& record) {
  if (record.travels || record.time.size() < 16) return std::nullopt;
  const auto [low, high] = std::ranges::minmax(record.motion);
  if (!(high > low)) return std::nullopt;
  const double span = record.time.back() - record.time.front();
  const auto sine = fit_sine(record.time, record.motion, record.frequency_hz);
  if (!(sine.frequency_hz > 0.0) || span * sine.frequency_hz < 1.999) return std::nullopt;

  const auto steady = steady_by(record, 1.0 / sine.frequency_hz);
  if (!steady) return std::nullopt;
  // A run-up biases the frequency of the whole, so that cycles seem to drift: again without it.
  const auto again = steady_by(record, steady->period);
  return again && again->cycles >= steady->cycles ? again : steady;
}

std::optional<LoopFigures> loop_figures(const TorsionRecord& record) {
  const auto smooth = reconstruct(record);
  if (!smooth || !smooth->steady) return std::nullopt;
  const std::optional<SteadyPart>& steady = smooth->steady;
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
