#pragma once

#include <optional>

#include "ode_fit/layout.hpp"

namespace flexspline::estimators {

/// States [instant][state] of an experiment before any fit, at increasing times from start_time on:
/// between the measurements where an output shows one state alone, else simulated with the starting
/// values, else (where that fails) as at the start.
std::vector<double> guess_states(const OdeLayout& layout, const LaidOutExperiment& experiment,
                                 std::span<const double> times, double tolerance);

/// The output that shows this state and no other.
std::optional<std::size_t> output_that_shows(const LaidOutExperiment& experiment,
                                             std::size_t state);

}  // namespace flexspline::estimators
