#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "midpoint/steady_cycle.hpp"

#include "flexspline/estimators/midpoint_locus.hpp"

namespace flexspline::estimators {
namespace {

constexpr int kPairs = 199;
constexpr double kLeastPurity = 0.8;

MidpointLocus locus_of(const SineFit& sine) {
  return {.amplitude = sine.amplitude,
          .angular_frequency = 2.0 * std::numbers::pi * sine.frequency_hz,
          .phase = sine.phase,
          .centre = sine.mean,
          .purity = sine.explained};
}

SineFit sine_of(const TorsionRecord& record, const SteadyPart& steady) {
  const std::size_t length = steady.last - steady.first;
  return fit_sine(std::span(record.time).subspan(steady.first, length),
                  std::span(record.motion).subspan(steady.first, length), 1.0 / steady.period);
}

}  // namespace

Result<MidpointLocus> midpoint_locus(const TorsionRecord& record, LocusSpeed speed) {
  const auto steady = find_steady_part(record);
  if (!steady) {
    return failure(ErrorCode::numerics,
                   fmt::format("recording {} does not repeat over two cycles", record.id),
                   "the midpoint method needs a loop: a periodic motion held for two cycles or "
                   "more");
  }
  MidpointLocus locus = locus_of(sine_of(record, *steady));
  if (speed == LocusSpeed::pure_sine && locus.purity < kLeastPurity) {
    return failure(ErrorCode::numerics,
                   fmt::format("a sine explains {:.0f} % of the motion of recording {}",
                               100.0 * locus.purity, record.id),
                   "record a sine, or take the measured speed: option speed = \"measured\"");
  }
  const auto cycle = SteadyCycle::of(record, *steady);
  if (!cycle) return tl::unexpected(cycle.error());
  locus.cycles = cycle->cycles();
  const double middle = 0.5 * (cycle->highest() + cycle->lowest());
  const double half = 0.5 * (cycle->highest() - cycle->lowest());
  for (int k = 1; k <= kPairs; ++k) {
    const double x = middle + half * std::cos(std::numbers::pi * k / (kPairs + 1));
    const double up = cycle->rising_at(x);
    const double down = cycle->falling_at(x);
    const double from_centre = x - locus.centre;
    const double sine =
        locus.angular_frequency *
        std::sqrt(std::max(0.0, locus.amplitude * locus.amplitude - from_centre * from_centre));
    const bool pure = speed == LocusSpeed::pure_sine;
    locus.motion.push_back(from_centre);
    locus.rising_rate.push_back(pure ? sine : std::abs(cycle->speed(up)));
    locus.falling_rate.push_back(pure ? sine : std::abs(cycle->speed(down)));
    locus.midpoint.push_back(0.5 * (cycle->effort(up) + cycle->effort(down)));
    locus.distance.push_back(0.5 * (cycle->effort(up) - cycle->effort(down)));
  }
  return locus;
}

}  // namespace flexspline::estimators
