#include "torque_driven/series.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "flexspline/core/in_parallel.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kEven = 1e-9;  // relative jitter up to which sampling counts as even

bool is_valid(const TorsionRecord& record, std::size_t i) {
  return i >= record.valid.size() || record.valid[i];
}

// Whether two valid values differ.
bool varies(const TorsionRecord& record, std::span<const double> values) {
  std::optional<double> first;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!is_valid(record, i) || std::isnan(values[i])) continue;
    if (!first) first = values[i];
    if (values[i] > *first || values[i] < *first) return true;
  }
  return false;
}

// Four at a time: a comparison does not wait for the one before.
double largest(std::span<const double> values) {
  std::array<double, 4> most{};
  std::size_t i = 0;
  for (; i + most.size() <= values.size(); i += most.size()) {
    for (std::size_t k = 0; k < most.size(); ++k) {
      most[k] = std::max(most[k], std::abs(values[i + k]));
    }
  }
  for (; i < values.size(); ++i) most[0] = std::max(most[0], std::abs(values[i]));
  return std::ranges::max(most);
}

double largest_valid(const TorsionRecord& record, std::span<const double> values) {
  if (std::ranges::find(record.valid, false) == record.valid.end()) return largest(values);
  double result = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (is_valid(record, i)) result = std::max(result, std::abs(values[i]));
  }
  return result;
}

Result<void> check(const TorsionRecord& record) {
  if (record.time.size() < 16) {
    return failure(ErrorCode::bad_data,
                   fmt::format("recording {} has {} samples", record.id, record.time.size()),
                   "give 16 or more");
  }
  const bool moves = varies(record, record.motion);
  if (!moves || !varies(record, record.effort)) {
    return failure(ErrorCode::bad_data,
                   fmt::format("recording {} has no {}", record.id, moves ? "torque" : "motion"),
                   "leave it out");
  }
  return {};
}

// Three-point slopes, as those of the core's spline.
std::vector<double> spline_slopes(std::span<const double> time, std::span<const double> y) {
  const std::size_t n = y.size();
  std::vector<double> slope(n);
  double secant = (y[1] - y[0]) / (time[1] - time[0]);
  const double first = secant;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double left = time[i] - time[i - 1];
    const double right = time[i + 1] - time[i];
    const double next = (y[i + 1] - y[i]) / right;
    slope[i] = (secant * right + next * left) / (left + right);
    secant = next;
  }
  slope[0] = 2.0 * first - slope[1];
  slope[n - 1] = 2.0 * secant - slope[n - 2];
  return slope;
}

double even_step(std::span<const double> time) {
  const double mean = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  for (std::size_t i = 1; i < time.size(); ++i) {
    const double off = time[i] - time[i - 1] - mean;
    if (std::abs(off) > kEven * mean + 1e-14 * std::abs(time[i])) return 0.0;
  }
  return mean;
}

std::size_t reading_span_of(const DrivenSeries& series) {
  constexpr double kChange = 0.1;
  const std::size_t longest = series.intervals() / 4;
  std::size_t span = 2;
  for (; 2 * span <= longest; span *= 2) {
    double moved = 0.0;
    double peak = 0.0;
    std::size_t count = 0;
    for (std::size_t i = span; i < series.motion.size(); i += span, ++count) {
      if (!(series.weight[i] > 0.0 && series.weight[i - span] > 0.0)) continue;
      moved += std::abs(series.motion[i] - series.motion[i - span]);
      peak = std::max(peak, std::abs(series.motion[i]));
    }
    if (moved >= kChange * peak * static_cast<double>(count)) break;
  }
  return span;
}

// largest_motion: of the valid samples.
DrivenSeries series_of(const TorsionRecord& record, double largest_motion, double motion_scale,
                       double torque_scale, InitialMotion initial) {
  DrivenSeries one;
  one.id = record.id;
  one.time = record.time;
  const std::size_t n = record.time.size();
  one.torque.resize(n);
  one.motion.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    one.torque[i] = record.effort[i] / torque_scale;
    one.motion[i] = record.motion[i] / motion_scale;
  }
  one.torque_slope = spline_slopes(one.time, one.torque);
  one.step = even_step(one.time);
  one.initial = initial == InitialMotion::rest ? 0.0 : one.motion.front();
  const double peak = record.amplitude.value_or(0.0) > 0.0 ? *record.amplitude : largest_motion;
  one.weight.assign(n, motion_scale / peak);
  for (std::size_t i = 0; i < record.valid.size(); ++i) {
    if (record.valid[i]) continue;
    one.weight[i] = 0.0;
    one.all_valid = false;
  }
  one.counted = static_cast<std::size_t>(
      std::count_if(one.weight.begin() + 1, one.weight.end(), [](double w) { return w > 0.0; }));
  one.reading_span = reading_span_of(one);
  return one;
}

}  // namespace

std::size_t DrivenProblem::residuals() const {
  std::size_t count = 0;
  for (const auto& one : series) count += one.counted;
  return count;
}

Result<DrivenProblem> driven_problem(const std::vector<TorsionRecord>& records, int f, int g, int h,
                                     InitialMotion initial, std::size_t threads) {
  DrivenProblem problem{
      .motion_scale = 0.0, .torque_scale = 0.0, .f = f, .g = g, .h = h, .series = {}};
  if (records.empty()) {
    return failure(ErrorCode::bad_data, "there is no recording to train on",
                   "mark one with split = \"train\"");
  }
  const std::size_t count = records.size();
  std::vector<Result<void>> checked(count);
  std::vector<double> motions(count);
  std::vector<double> torques(count);
  in_parallel(count, threads, [&](std::size_t i) {
    checked[i] = check(records[i]);
    if (!checked[i]) return;
    motions[i] = largest_valid(records[i], records[i].motion);
    torques[i] = largest_valid(records[i], records[i].effort);
  });
  for (const auto& one : checked) {
    if (!one) return tl::unexpected(one.error());
  }
  problem.motion_scale = std::ranges::max(motions);
  problem.torque_scale = std::ranges::max(torques);
  problem.series.resize(count);
  in_parallel(count, threads, [&](std::size_t i) {
    problem.series[i] =
        series_of(records[i], motions[i], problem.motion_scale, problem.torque_scale, initial);
  });
  if (problem.residuals() <= problem.size()) {
    return failure(
        ErrorCode::bad_data,
        fmt::format("{} samples count, for {} coefficients", problem.residuals(), problem.size()),
        "record longer, or fit fewer terms");
  }
  return problem;
}

std::vector<double> driven_start(const DrivenProblem& problem) {
  constexpr double kHigher = 0.1;  // of higher terms, over the linear one
  double torque_motion = 0.0;
  double motion_motion = 0.0;
  double speed_speed = 0.0;
  double lost = 0.0;
  for (const auto& one : problem.series) {
    const std::size_t span = one.reading_span;
    for (std::size_t i = span; i < one.time.size(); i += span) {
      if (!(one.weight[i] > 0.0 && one.weight[i - span] > 0.0)) continue;
      const double moved = one.motion[i] - one.motion[i - span];
      torque_motion += one.torque[i] * one.motion[i];
      motion_motion += one.motion[i] * one.motion[i];
      speed_speed += moved * moved / (one.time[i] - one.time[i - span]);
      lost += moved * one.torque[i - span / 2];
    }
  }
  const double stiffness = torque_motion > 0.0 ? torque_motion / motion_motion : 1.0;
  const double damper = lost > 0.0 ? speed_speed / lost : 1.0;
  std::vector<double> p(problem.size(), 0.0);
  for (int k = 0; k < problem.f; ++k)
    p[static_cast<std::size_t>(k)] = stiffness * (k == 0 ? 1.0 : kHigher);
  for (int k = 0; k < problem.g; ++k) {
    p[static_cast<std::size_t>(problem.f + k)] = damper * (k == 0 ? 1.0 : kHigher);
  }
  return p;
}

bool driven_admissible(const DrivenProblem& problem, std::span<const double> p) {
  return problem.g == 0 || p[static_cast<std::size_t>(problem.f)] > 0.0;
}

}  // namespace flexspline::estimators
