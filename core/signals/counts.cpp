#include "flexspline/core/counts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace flexspline {
namespace {

constexpr double kLeast = 1e-6;     // of the range: what is finer are no counts, but digits
constexpr double kRounding = 0.02;  // of a level: counts are printed with few digits
// Different values that last: by chance all are even counts in one of 2^15.
constexpr std::size_t kHeld = 16;

// Samples that last: of counts resampled on a grid those that are no mixture of two.
std::vector<double> held(std::span<const double> samples) {
  std::vector<double> values;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (samples[i] != samples[i - 1]) continue;
    if (values.empty() || values.back() != samples[i]) values.push_back(samples[i]);
  }
  return values;
}

std::size_t different(std::vector<double> values) {
  std::ranges::sort(values);
  const auto same = std::ranges::unique(values);
  return values.size() - same.size();
}

std::vector<double> steps_of(std::span<const double> samples) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    steps.push_back(std::abs(samples[i] - samples[i - 1]));
  }
  std::ranges::sort(steps);
  return steps;
}

// The greatest of which both are whole numbers, but for rounding (Euclid); of many levels it is
// known better.
double common_part(double many, double few) {
  const double times = std::round(many / few);
  const double rest = std::abs(many - times * few);
  return rest > kRounding * few ? common_part(few, rest) : many / times;
}

/// Samples of one value that follow each other.
struct Run {
  double value = 0.0;
  std::size_t length = 0;
};

std::vector<Run> runs_of(std::span<const double> samples, double level) {
  std::vector<Run> runs;
  for (const double x : samples) {
    if (runs.empty() || std::abs(x - runs.back().value) > 0.5 * level) runs.push_back({x, 0});
    ++runs.back().length;
  }
  return runs;
}

bool is_passed(const Run& before, const Run& run, const Run& after) {
  return (run.value - before.value) * (after.value - run.value) > 0.0 &&
         run.length <= 2 * std::min(before.length, after.length);
}

// The level of which all distances of two samples that follow each other are a whole number.
double common_level(std::span<const double> samples) {
  const std::vector<double> steps = steps_of(samples);
  const auto [low, high] = std::ranges::minmax(samples);
  const double least = kLeast * (high - low);
  const auto first = std::ranges::upper_bound(steps, kRounding * least);
  if (first == steps.end()) return 0.0;
  double level = *first;
  for (auto step = first; step != steps.end() && level > least; ++step) {
    level = common_part(*step, level);
  }
  return level <= least ? 0.0 : level;
}

// No two samples alike, and all a level apart: a ramp that no counter has read.
bool is_a_ramp(std::span<const double> samples, double level) {
  const std::vector<double> steps = steps_of(samples);
  return steps.front() > kRounding * level && steps.back() < 1.5 * level;
}

}  // namespace

double level_of_counts(std::span<const double> samples) {
  const std::vector<double> values = held(samples);
  const double of_held = different(values) < kHeld ? 0.0 : common_level(values);
  if (of_held > 0.0) return of_held;
  const double level = samples.size() < 2 ? 0.0 : common_level(samples);
  return level > 0.0 && is_a_ramp(samples, level) ? 0.0 : level;
}

double deviation_of_counts(std::span<const double> samples) {
  const double level = level_of_counts(samples);
  if (!(level > 0.0)) return 0.0;
  const std::vector<Run> runs = runs_of(samples, level);
  std::size_t passing = 0;
  for (std::size_t i = 1; i + 1 < runs.size(); ++i) {
    if (is_passed(runs[i - 1], runs[i], runs[i + 1])) passing += runs[i].length;
  }
  const double share = static_cast<double>(passing) / static_cast<double>(samples.size());
  return level * std::sqrt(share / 12.0);
}

}  // namespace flexspline
