#include "given_model/given_draw.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace flexspline::estimators {
namespace {

constexpr double kSpread = 4.0;

}  // namespace

std::vector<GivenParameter> drawn_start(std::vector<GivenParameter> given, std::uint64_t seed,
                                        int start) {
  if (start == 0) return given;
  std::seed_seq seeds{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                      static_cast<std::uint32_t>(start)};
  std::mt19937_64 engine(seeds);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (GivenParameter& one : given) {
    const double factor = std::pow(kSpread, uniform(engine));
    if (!one.held) one.start = std::clamp(one.start * factor, one.lower, one.upper);
  }
  return given;
}

}  // namespace flexspline::estimators
