#pragma once

#include "ode_fit/layout.hpp"

namespace flexspline::estimators {

/// A stretch of trajectory with its derivatives by the unknowns that it depends on.
struct Shot {
  std::vector<std::size_t> unknown;  ///< of every direction
  std::size_t states = 0;
  std::vector<double> state;        ///< [instant][state]
  std::vector<double> sensitivity;  ///< [instant][state][direction]; empty where not asked for

  std::span<const double> at(std::size_t instant) const {
    return std::span(state).subspan(instant * states, states);
  }
  double derivative(std::size_t instant, std::size_t i, std::size_t direction) const {
    return sensitivity[(instant * states + i) * unknown.size() + direction];
  }
};

/// Integrates from start at times.front() through the times.
Result<Shot> shoot(const OdeLayout& layout, std::span<const double> q,
                   std::span<const Source> start, std::span<const double> times, double tolerance,
                   bool with_sensitivity);

}  // namespace flexspline::estimators
