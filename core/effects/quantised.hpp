#pragma once

#include <cmath>
#include <span>

#include "flexspline/core/effect.hpp"

namespace flexspline {

/// Quantisation at one instant: its mean, 0. Its derivative is 0 or infinite, of no use to a fit;
/// signals are mapped.
struct MeanOfQuantisation {
  template <class S>
  static S term(const Instant<S>&, std::span<const S>, std::span<const S>) {
    return S(0.0);
  }
};

/// Every sample becomes the nearest multiple of parameters[0]; a step of 0 leaves it.
inline void quantise_signal(std::span<const double>, std::span<double> signal,
                            std::span<const double> parameters) {
  const double step = parameters[0];
  if (step <= 0.0) return;
  for (double& value : signal) value = step * std::round(value / step);
}

}  // namespace flexspline
