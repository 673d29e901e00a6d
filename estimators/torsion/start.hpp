#pragma once

#include <vector>

#include "torsion/layout.hpp"
#include "torsion/prepared_record.hpp"

namespace flexspline::estimators {

/// Bounds and typical sizes of all parameters of a layout, starting from p.
std::vector<BoundedParameter> bounded_parameters(const TorsionLayout& layout,
                                                 const std::vector<PreparedRecord>& records,
                                                 std::span<const double> p);

/// A layout, and where linear least squares puts its f, g^-1 and offset with h = 1.
struct LinearStart {
  TorsionLayout layout;
  std::vector<double> p;
};

/// f and g^-1 monotone with two sides each (f free where the motion travels).
Result<LinearStart> richest_start(const std::vector<PreparedRecord>& records, FreeTerms base);

/// f and g^-1 each odd or with two sides of its own, g^-1 with knots in even steps or in decades,
/// as the Bayesian criterion of eq. (4) prefers. The directions of the terms that will be free
/// beside them, taken at the richest start, compete in it, so that a class is not chosen to stand
/// in for one of them.
Result<LinearStart> chosen_start(const std::vector<PreparedRecord>& records, FreeTerms base,
                                 const LinearStart& richest, FreeTerms beside);

/// f and g^-1 monotone, with so many even intervals on each of two sides.
Result<LinearStart> even_start(const std::vector<PreparedRecord>& records, FreeTerms base,
                               std::size_t intervals);

/// A layout with the same laws and other free terms, and its parameters.
LinearStart with_terms(const LinearStart& start, FreeTerms free);

/// Largest and smallest degree of ln h where it is free.
inline constexpr std::size_t kModulationTerms = 4;
inline constexpr std::size_t kFewestModulationTerms = 2;

}  // namespace flexspline::estimators
