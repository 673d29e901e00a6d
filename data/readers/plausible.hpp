#pragma once

#include <string>

#include "flexspline/core/error.hpp"
#include "flexspline/core/units.hpp"

namespace flexspline::data {

/// What a bench can measure, in SI: far beyond every bench, and so that squares and products of
/// what is inside neither overflow nor vanish.
struct PlausibleRange {
  double low;
  double high;
};

/// Angles 1e9 rad, angular velocities 1e7 rad/s, lengths 1e6 m, velocities 1e6 m/s, torques
/// 1e9 Nm, forces 1e10 N, currents 1e6 A, voltages 1e7 V, times 1e11 s and ratios 1e6 either way;
/// temperatures 0 to 1e4 K.
PlausibleRange plausible_range(Dimension dimension);

/// "values of dimension angle are at most 1e+09 rad".
std::string plausible_words(Dimension dimension);

/// Values that differ by no more are one value: 1e-15 in SI, and 1e-13 of the larger.
double negligible_change(double low, double high);

}  // namespace flexspline::data
