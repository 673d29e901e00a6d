#pragma once

#include <string>

#include "flexspline/core/recording.hpp"

namespace flexspline::studies {

/// A sine without samples yet, told by its number, which is its place in the session, too.
inline Recording numbered_sine(double amplitude, double frequency, unsigned number) {
  Recording r;
  r.id = "sine-" + std::to_string(number);
  r.start_s = 100.0 * number;
  r.amplitude = amplitude;
  r.frequency_hz = frequency;
  return r;
}

}  // namespace flexspline::studies
