#include "bench/counter_noise.hpp"

#include <cmath>
#include <numbers>

namespace flexspline::data {
namespace {

constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15u;

std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

/// FNV-1a.
std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xCBF29CE484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3u;
  return hash;
}

/// In (0, 1), never 0.
double uniform(std::uint64_t key, std::uint64_t counter) {
  const std::uint64_t bits = mixed(key + (counter + 1) * kGolden) >> 11;
  return (static_cast<double>(bits) + 0.5) * 0x1p-53;
}

}  // namespace

CounterNoise::CounterNoise(std::uint64_t seed, std::string_view id, std::uint64_t stream)
    : key_(mixed(mixed(mixed(seed + kGolden) ^ hash_of(id)) + (stream + 1) * kGolden)) {}

double CounterNoise::normal(std::uint64_t index) const {
  const double radius = std::sqrt(-2.0 * std::log(uniform(key_, 2 * index)));
  return radius * std::cos(2.0 * std::numbers::pi * uniform(key_, 2 * index + 1));
}

}  // namespace flexspline::data
