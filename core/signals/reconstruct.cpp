#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "flexspline/core/signals.hpp"
#include "signals/smoothing.hpp"

namespace flexspline {
namespace {

double smoothstep(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

void blend(std::vector<double>& into, const std::vector<double>& from, std::size_t i,
           std::size_t j, double weight) {
  into[i] = (1.0 - weight) * into[i] + weight * from[j];
}

// The transient by a spline, the steady part by its harmonics; they meet over a quarter of a cycle.
SmoothSignal smooth(const TorsionRecord& record, std::span<const double> samples,
                    const std::optional<SteadyPart>& steady) {
  const std::span<const double> time(record.time);
  if (!steady) return smooth_by_spline(time, samples);
  const auto periodic = smooth_by_harmonics(time.subspan(steady->first),
                                            samples.subspan(steady->first), steady->period);
  if (steady->first == 0) return periodic;

  const double joint = time[steady->first];
  const auto overlap_end = std::upper_bound(time.begin(), time.end(), joint + 0.5 * steady->period);
  const auto transient = std::max<std::size_t>(
      16, static_cast<std::size_t>(overlap_end - time.begin()));
  auto signal = smooth_by_spline(time.first(transient), samples.first(transient));
  for (auto* part : {&signal.value, &signal.rate, &signal.second, &signal.error}) part->resize(time.size());
  signal.noise = periodic.noise;
  for (std::size_t i = steady->first; i < time.size(); ++i) {
    const std::size_t j = i - steady->first;
    const double weight =
        i < transient ? smoothstep((time[i] - joint) / (0.25 * steady->period)) : 1.0;
    blend(signal.value, periodic.value, i, j, weight);
    blend(signal.rate, periodic.rate, i, j, weight);
    blend(signal.second, periodic.second, i, j, weight);
    blend(signal.error, periodic.error, i, j, weight);
  }
  return signal;
}

}  // namespace

Result<Reconstruction> reconstruct(const TorsionRecord& record) {
  if (record.time.size() < 16) {
    return failure(ErrorCode::numerics,
                   fmt::format("recording {} has {} samples", record.id, record.time.size()),
                   "16 or more are needed to tell signal from noise");
  }
  const auto [low, high] = std::ranges::minmax(record.motion);
  if (!(high > low)) {
    return failure(ErrorCode::numerics, fmt::format("recording {} does not move", record.id),
                   "leave it out, or check the channel of its motion");
  }
  Reconstruction result;
  result.steady = find_steady_part(record);
  auto motion = smooth(record, record.motion, result.steady);
  auto effort = smooth(record, record.effort, result.steady);
  result.motion = {.time = record.time,
                   .position = std::move(motion.value),
                   .velocity = std::move(motion.rate),
                   .acceleration = std::move(motion.second)};
  result.motion_noise = motion.noise;
  result.motion_error = std::move(motion.error);
  result.effort = std::move(effort.value);
  result.effort_noise = effort.noise;
  return result;
}

}  // namespace flexspline
