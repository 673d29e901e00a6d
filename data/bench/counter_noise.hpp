#pragma once

#include <cstdint>
#include <string_view>

namespace flexspline::data {

/// Standard normal numbers by counter: each is a pure function of (seed, id, stream, index), so
/// that neither order nor the number of workers matters. SplitMix64's finaliser and Box-Muller.
class CounterNoise {
 public:
  CounterNoise(std::uint64_t seed, std::string_view id, std::uint64_t stream);

  double normal(std::uint64_t index) const;

 private:
  std::uint64_t key_;
};

}  // namespace flexspline::data
