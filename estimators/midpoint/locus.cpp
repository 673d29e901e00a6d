#include "midpoint/locus.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "flexspline/core/signals.hpp"
#include "flexspline/core/spline.hpp"

namespace flexspline::estimators {
namespace {

constexpr int kPairs = 199;
constexpr double kLeastPurity = 0.8;

}  // namespace

Result<MidpointLocus> midpoint_locus(const TorsionRecord& record) {
  const auto steady = find_steady_part(record);
  if (!steady) {
    return failure(ErrorCode::numerics,
                   fmt::format("recording {} does not repeat over two cycles", record.id),
                   "the midpoint method needs a loop: a sine held for two cycles or more");
  }
  const std::span<const double> time(record.time);
  const std::span<const double> motion(record.motion);
  const std::size_t length = steady->last - steady->first;
  const SineFit sine = fit_sine(time.subspan(steady->first, length),
                                motion.subspan(steady->first, length), 1.0 / steady->period);
  if (sine.explained < kLeastPurity) {
    return failure(ErrorCode::numerics,
                   fmt::format("a sine explains {:.0f} % of the motion of recording {}",
                               100.0 * sine.explained, record.id),
                   "the midpoint method takes its speed from a pure sine; use trajectory_ceres");
  }
  MidpointLocus locus{.amplitude = sine.amplitude,
                      .angular_frequency = 2.0 * std::numbers::pi * sine.frequency_hz,
                      .phase = sine.phase,
                      .centre = sine.mean,
                      .purity = sine.explained,
                      .cycles = steady->cycles};
  const Spline effort(record.time, record.effort);
  const double w = locus.angular_frequency;
  const double period = 2.0 * std::numbers::pi / w;
  const double from = time[steady->first];
  // The first crest of the sine in the steady part.
  const double turns = std::ceil((w * from + sine.phase) / (2.0 * std::numbers::pi));
  const double crest = (2.0 * std::numbers::pi * turns - sine.phase) / w;
  const int cycles = static_cast<int>((time[steady->last - 1] - crest) / period + 1e-3);
  if (cycles < 1) {
    return failure(ErrorCode::numerics,
                   fmt::format("recording {} holds no whole cycle from crest to crest", record.id),
                   "record two cycles or more");
  }
  for (int k = 1; k <= kPairs; ++k) {
    const double angle = std::numbers::pi * k / (kPairs + 1);
    double falling = 0.0;
    double rising = 0.0;
    for (int c = 0; c < cycles; ++c) {
      falling += effort.value(crest + c * period + angle / w) / cycles;
      rising += effort.value(crest + (c + 1) * period - angle / w) / cycles;
    }
    locus.motion.push_back(sine.amplitude * std::cos(angle));
    locus.rate.push_back(sine.amplitude * w * std::sin(angle));
    locus.midpoint.push_back(0.5 * (rising + falling));
    locus.distance.push_back(0.5 * (rising - falling));
  }
  return locus;
}

}  // namespace flexspline::estimators
