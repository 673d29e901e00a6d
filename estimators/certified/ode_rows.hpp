#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "flexspline/core/twice_ode_system.hpp"
#include "flexspline/estimators/certified_ode.hpp"

namespace flexspline::estimators {

/// Rates that are not negative, one a start; the name of each is that of its kind and its number.
std::vector<OdeParameter> rates(const std::string& kind, std::vector<double> starts,
                                const std::string& unit, double scale = 1.0);

/// Every state measured with noise 1, from a known initial state at time 0.
OdeExperiment fully_observed(std::string id, std::vector<double> initial, std::vector<double> times,
                             std::vector<double> measured);

}  // namespace flexspline::estimators
