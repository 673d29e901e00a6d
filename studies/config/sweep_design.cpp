#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <boost/random/sobol.hpp>

#include "config/study_source.hpp"

namespace flexspline::studies {

std::vector<std::vector<double>> latin_hypercube(std::size_t count, std::size_t dimensions,
                                                 std::uint64_t seed) {
  std::mt19937_64 bits(seed);  // its bits are the same everywhere, unlike std's distributions
  const auto unit = [&] { return static_cast<double>(bits() >> 11U) * 0x1.0p-53; };
  std::vector<std::vector<double>> points(count, std::vector<double>(dimensions));
  std::vector<std::size_t> slices(count);
  for (std::size_t d = 0; d < dimensions; ++d) {
    std::iota(slices.begin(), slices.end(), std::size_t{0});
    for (std::size_t i = count; i > 1; --i) {
      const auto other = static_cast<std::size_t>(unit() * static_cast<double>(i));
      std::swap(slices[i - 1], slices[std::min(other, i - 1)]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      points[i][d] = (static_cast<double>(slices[i]) + unit()) / static_cast<double>(count);
    }
  }
  return points;
}

std::vector<std::vector<double>> sobol_points(std::size_t count, std::size_t dimensions) {
  boost::random::sobol sequence(dimensions);  // Joe and Kuo's directions; without the origin
  std::vector<std::vector<double>> points(count, std::vector<double>(dimensions));
  for (std::vector<double>& point : points) {
    for (double& u : point) u = std::ldexp(static_cast<double>(sequence()), -64);
  }
  return points;
}

SweepValue SweepRange::at(double u) const {
  if (log) return from * std::pow(to / from, u);
  return from + u * (to - from);
}

}  // namespace flexspline::studies
