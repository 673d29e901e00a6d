#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "flexspline/estimators/ode_fit.hpp"

namespace flexspline::estimators {

struct OdeSearchSettings {
  int searches = 4;         ///< from the given start and from others drawn about it
  long evaluations = 1500;  ///< simulations of all experiments, of each search
  std::uint64_t seed = 1;
  double spread = 2.0;  ///< starts are drawn within this factor, of numbers not searched by their
                        ///< logarithm within as many scales; first candidates deviate by half of it
  std::map<std::string, double> spreads{};  ///< of unknowns by name, instead of that
  double same_cost = 1e-2;                  ///< relative difference of costs that count as one
};

/// Where searches without derivatives end.
struct OdeSearch {
  std::vector<double> best;  ///< the system's parameters, then free initial values
  double cost = kNotComputed;
  std::vector<double> costs;  ///< of all searches, in their order; infinite: found nothing
  int at_best = 0;            ///< within same_cost of the best
  long evaluations = 0;
  std::string says;  ///< how many came home, with the 95 % interval of their share
};

/// The cost of single shooting, lowered by evolution strategies (CMA-ES) within the bounds: for
/// problems whose cost is rugged or has cliffs, where derivatives lead nowhere, as of stick-slip.
/// Numbers whose start is positive and whose lower bound is not negative are searched by their
/// logarithm, down to a thousandth of the start. Only costs are compared: no minimum is certified,
/// and fit_ode is to be started at the best. copies: the same problem, each with a system of its
/// own, one a thread; results do not depend on how many.
/// Errors: those of the description and settings as fit_ode has them; usage for settings out of
/// range; numerics where no candidate of any search can be integrated.
Result<OdeSearch> search_ode(std::span<const OdeFitProblem> copies, const OdeFitSettings& settings,
                             const OdeSearchSettings& search = {});

/// The cost of single shooting at unknowns (the system's parameters, then free initial values),
/// simulated without derivatives. Errors: those of the integration.
Result<double> ode_cost(const OdeFitProblem& problem, const OdeFitSettings& settings,
                        std::span<const double> unknowns);

}  // namespace flexspline::estimators
