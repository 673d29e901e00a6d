#include "comparison/recording_zero.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flexspline/core/simulate.hpp"

namespace flexspline::studies {
namespace {

constexpr std::string_view kPrefix = "zero[";

double misfit(const ModelSpec& model, Motion motion, const ComparedSeries& series, double zero) {
  for (double& position : motion.position) position -= zero;
  const auto simulated = simulate_torque(model, motion);
  if (!simulated) return std::numeric_limits<double>::infinity();
  const double rms = compared_rms(series, *simulated, series.measured);
  return std::isfinite(rms) ? rms : std::numeric_limits<double>::infinity();
}

/// Golden section between two points about a minimum.
template <class Function>
double golden_section(const Function& value, double low, double high) {
  constexpr double kRatio = 0.6180339887498949;
  double left = high - kRatio * (high - low);
  double right = low + kRatio * (high - low);
  double at_left = value(left);
  double at_right = value(right);
  for (int step = 0; step < 24; ++step) {
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      at_left = value(left = high - kRatio * (high - low));
    } else {
      low = left;
      left = right;
      at_left = at_right;
      at_right = value(right = low + kRatio * (high - low));
    }
  }
  return 0.5 * (low + high);
}

struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void take_in(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

/// Within the motion and the zeros of other recordings: a small motion may be far from its own.
double search_zero(const ModelSpec& model, const Motion& motion, const ComparedSeries& series,
                   Interval known) {
  for (const double x : motion.position) known.take_in(x);
  const auto [low, high] = known;
  constexpr int kSteps = 40;
  const double step = (high - low) / kSteps;
  double best = low;
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSteps; ++i) {
    const double value = misfit(model, motion, series, low + step * i);
    if (value >= smallest) continue;
    smallest = value;
    best = low + step * i;
  }
  const auto value = [&](double zero) { return misfit(model, motion, series, zero); };
  return golden_section(value, best - step, best + step);
}

}  // namespace

Result<double> recording_zero(const Estimate& estimate, const std::string& id, const Motion& motion,
                              const ComparedSeries& series) {
  double sum = 0.0;
  int count = 0;
  Interval known;
  for (const ParameterEstimate& parameter : estimate.parameters) {
    if (!parameter.name.starts_with(kPrefix)) continue;
    if (parameter.name == std::string(kPrefix) + id + "]") return parameter.value;
    sum += parameter.value;
    known.take_in(parameter.value);
    ++count;
  }
  if (count == 0) return 0.0;
  const bool virtual_bench = !series.truth.empty();
  return virtual_bench ? sum / count : search_zero(estimate.model, motion, series, known);
}

}  // namespace flexspline::studies
