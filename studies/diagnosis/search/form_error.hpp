#pragma once

#include "diagnosis/search/search.hpp"

namespace flexspline::studies {

/// Of what a cause explains, the share that an error in the form of another does not: the rise of
/// the sum of squares without the one, where the other's contribution c may also be modulated by
/// torsion, rate, torque and time, grow like c^3, and come earlier or later; over the rise where it
/// may not. Shapes as they stand, coefficients free in each equation. 1 where they share no
/// equation.
double share_beyond_form(const Frame& frame, const Findings& findings, std::size_t cause,
                         std::size_t other);

}  // namespace flexspline::studies
