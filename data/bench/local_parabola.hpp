#pragma once

#include <vector>

#include "bench/hidden_jet.hpp"

namespace flexspline::data {

/// Value and derivatives of a series by the parabola that fits 11 samples about each best, in the
/// sense of least squares; exact for a parabola, whatever the instants.
std::vector<Jet> local_parabolas(const std::vector<double>& time,
                                 const std::vector<double>& values);

}  // namespace flexspline::data
