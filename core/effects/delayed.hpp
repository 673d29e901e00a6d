#pragma once

#include <span>

#include "flexspline/core/spline.hpp"

namespace flexspline {

/// signal(t) becomes signal(t - delay), by a cubic spline held constant beyond its ends.
/// Fewer than three samples stay as they are.
inline void delay_signal(std::span<const double> time, std::span<double> signal, double delay) {
  if (delay == 0.0 || time.size() < 3) return;
  const Spline sampled(time, signal);
  for (std::size_t i = 0; i < signal.size(); ++i) signal[i] = sampled.value(time[i] - delay);
}

}  // namespace flexspline
