#pragma once

#include <span>
#include <vector>

#include "flexspline/core/ode_system.hpp"

namespace flexspline {

/// Absolute tolerances of the states: those of the settings, or the relative one for each.
std::vector<double> state_tolerances(const SystemSettings& settings, std::size_t states);

/// Those of the states, then of dy/dp by columns: a change of p by its own size is to count like a
/// change of the state.
std::vector<double> column_tolerances(const SystemSettings& settings, std::size_t states,
                                      std::span<const double> p);

/// |p|, or 1 for a parameter that is zero.
double parameter_scale(double value);

}  // namespace flexspline
