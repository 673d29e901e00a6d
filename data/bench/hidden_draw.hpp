#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>

#include "bench/counter_noise.hpp"

namespace flexspline::data {

/// Uniform in (low, high): a pure function of (seed, name, index), from the bench's normal numbers.
inline double drawn(std::uint64_t seed, std::string_view name, std::uint64_t index, double low,
                    double high) {
  const CounterNoise noise(seed, name, 97);
  const double share = 0.5 * std::erfc(-noise.normal(index) / std::sqrt(2.0));
  return low + share * (high - low);
}

}  // namespace flexspline::data
