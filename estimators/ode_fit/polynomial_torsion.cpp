#include "flexspline/estimators/polynomial_torsion.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace flexspline::estimators {

std::string PolynomialTorsionLimits::name(std::size_t i) const {
  static constexpr const char* kNames[] = {"f' at x", "g' at z", "ln h at x"};
  return fmt::format("{} = {:.3g}", kNames[i / limits_.points], at(i % limits_.points));
}

double PolynomialTorsionLimits::lower(std::size_t i) const {
  return i / limits_.points < 2 ? limits_.slope : std::log(limits_.lowest_h);
}

double PolynomialTorsionLimits::upper(std::size_t i) const {
  return i / limits_.points < 2 ? std::numeric_limits<double>::infinity()
                                : std::log(limits_.highest_h);
}

}  // namespace flexspline::estimators
