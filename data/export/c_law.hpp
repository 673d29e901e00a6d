#pragma once

#include <string>
#include <vector>

#include "flexspline/core/law.hpp"

namespace flexspline::data {

/// A cubic on every interval between breaks, c0 + c1 d + c2 d^2 + c3 d^3 with d from its left end,
/// and straight lines beyond the outer breaks.
struct CubicPieces {
  std::vector<double> breaks;
  std::vector<std::array<double, 4>> pieces;  ///< one fewer than breaks
};

/// A spline law as its pieces, exact to rounding; empty for a law that is no spline.
CubicPieces cubic_pieces(const Law& law);

/// A law as a C function "static double <name>(double x)", exact to rounding.
/// Errors: a law that has no such form.
Result<std::string> c_law(const LawSpec& spec, const std::string& name);

}  // namespace flexspline::data
