#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "flexspline/core/nearest_name.hpp"
#include "flexspline/data/bench.hpp"

namespace flexspline::data {
namespace {

constexpr std::array<std::string_view, 7> kParts = {"stiffness", "damping", "modulation", "slip",
                                                    "harmonics", "inertia", "sensor_lag"};

std::function<double(double)> times(std::function<double(double)> function, double factor) {
  return [function = std::move(function), factor](double x) { return factor * function(x); };
}

void strengthen(BenchTruth& truth, const std::string& part, double factor) {
  if (part == "stiffness") truth.stiffness = times(std::move(truth.stiffness), factor);
  if (part == "damping") truth.damping = times(std::move(truth.damping), factor);
  if (part == "modulation") {
    truth.log_modulation = times(std::move(truth.log_modulation), factor);
  }
  if (part == "slip") {
    for (auto& [stiffness, yield] : truth.slip_elements) stiffness *= factor;
  }
  if (part == "harmonics") {
    for (auto& [order, wave] : truth.harmonics) wave.first *= factor;
  }
  if (part == "inertia") truth.inertia *= factor;
  if (part == "sensor_lag") truth.sensor_lag_s *= factor;
}

}  // namespace

Result<BenchTruth> strengthened(BenchTruth truth, const std::map<std::string, double>& strength) {
  for (const auto& [part, factor] : strength) {
    if (std::find(kParts.begin(), kParts.end(), part) == kParts.end()) {
      return failure(ErrorCode::usage, fmt::format("a truth of the bench has no part '{}'", part),
                     suggestion(part, kParts));
    }
    if (!(factor >= 0.0) || !std::isfinite(factor)) {
      return failure(ErrorCode::usage, fmt::format("the strength of {} is {}", part, factor),
                     "give a factor, 0 or above; 1 is as the truth has it");
    }
    strengthen(truth, part, factor);
  }
  return truth;
}

}  // namespace flexspline::data
