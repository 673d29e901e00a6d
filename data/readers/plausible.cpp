#include "readers/plausible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flexspline::data {
namespace {

struct Limit {
  Dimension dimension;
  double high;
  std::string_view unit;
};

constexpr double kHottest = 1e4;  // K

constexpr Limit kLimits[] = {
    {Dimension::dimensionless, 1e6, "1"}, {Dimension::time, 1e11, "s"},
    {Dimension::frequency, 1e9, "Hz"},    {Dimension::angle, 1e9, "rad"},
    {Dimension::length, 1e6, "m"},        {Dimension::angular_velocity, 1e7, "rad/s"},
    {Dimension::velocity, 1e6, "m/s"},    {Dimension::torque, 1e9, "Nm"},
    {Dimension::force, 1e10, "N"},        {Dimension::current, 1e6, "A"},
    {Dimension::voltage, 1e7, "V"},       {Dimension::temperature, kHottest, "K"},
};

const Limit& limit_of(Dimension dimension) {
  const auto* found = std::ranges::find(kLimits, dimension, &Limit::dimension);
  expects(found != std::end(kLimits), "every dimension has a limit");
  return *found;
}

}  // namespace

PlausibleRange plausible_range(Dimension dimension) {
  const double high = limit_of(dimension).high;
  return {dimension == Dimension::temperature ? 0.0 : -high, high};
}

std::string plausible_words(Dimension dimension) {
  const Limit& limit = limit_of(dimension);
  if (dimension == Dimension::temperature) return "temperatures are 0 K to 1e4 K";
  return fmt::format("values of dimension {} are at most {:g} {}", name_of(dimension), limit.high,
                     limit.unit);
}

double negligible_change(double low, double high) {
  return std::max(1e-15, 1e-13 * std::max(std::abs(low), std::abs(high)));
}

}  // namespace flexspline::data
