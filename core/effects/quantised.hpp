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

inline constexpr std::string_view kQuantisedRange =
    "any value; as white noise of q/sqrt(12) where the signal crosses many steps";
inline constexpr std::string_view kQuantisedNotModelled =
    "steps of unequal width; at an instant it counts as its mean, 0; what lay within a step does "
    "not "
    "come back";

/// The row of a quantised signal: what tells the signals apart, with the law they share.
inline EffectRow quantisation(EffectRow row) {
  row.passive = false;
  row.active_because = "an instrument: it shows what is not there, and does no work";
  row.rate_independent = true;
  instantiate<MeanOfQuantisation>(row);
  row.map = quantise_signal;
  return row;
}

}  // namespace flexspline
