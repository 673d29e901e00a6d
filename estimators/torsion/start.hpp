#pragma once

#include <vector>

#include "torsion/layout.hpp"
#include "torsion/prepared_record.hpp"

namespace flexspline::estimators {

/// Bounds and typical sizes of all parameters of a layout, starting from p.
std::vector<BoundedParameter> bounded_parameters(const TorsionLayout& layout,
                                                 const std::vector<PreparedRecord>& records,
                                                 std::span<const double> p);

/// Laws for these records: f and g^-1 monotone (f free where the motion travels), each odd or with
/// two sides of its own, g^-1 with knots in even steps or in decades, as the Bayesian criterion
/// prefers; and where the linear least squares of eq. (4) with h = 1 puts them.
struct LinearStart {
  TorsionLayout layout;
  std::vector<double> p;
};
Result<LinearStart> linear_start(const std::vector<PreparedRecord>& records, FreeTerms free);

/// A layout with the same laws and other free terms, and its parameters.
LinearStart with_terms(const LinearStart& start, FreeTerms free);

/// Largest and smallest degree of ln h where it is free.
inline constexpr std::size_t kModulationTerms = 4;
inline constexpr std::size_t kFewestModulationTerms = 2;

}  // namespace flexspline::estimators
