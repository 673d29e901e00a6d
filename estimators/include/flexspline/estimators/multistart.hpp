#pragma once

#include <cstdint>

#include "flexspline/estimators/ode_fit.hpp"

namespace flexspline::estimators {

struct MultistartSettings {
  int starts = 10;  ///< the given one and others drawn about it
  int enough = 0;   ///< starts that agree on the best cost and so end the search; 0: all are made
  std::uint64_t seed = 1;
  double spread = 4.0;      ///< values are drawn within this factor (sign kept), and where they are
                            ///< zero within as many scales
  double same_cost = 1e-6;  ///< relative difference of costs that count as one minimum
};

/// What fits from many starts say about each other.
struct Multistart {
  OdeFit best;
  int starts = 0;
  int failed = 0;               ///< without a result
  int converged = 0;            ///< at whatever minimum
  int at_best = 0;              ///< converged at the best cost found
  std::vector<double> costs{};  ///< of those with a result, in order of the starts
  double rate = kNotComputed;   ///< at_best / starts, with Clopper and Pearson's 95 % interval
  double rate_lower = kNotComputed;
  double rate_upper = kNotComputed;
  std::string says{};
};

/// Fits from many starts. The best fit counts as converged only if two starts agree on its cost;
/// otherwise its termination is no_progress and a note says so. Starts after the first leave the
/// equation-error start aside, so that they are independent of it.
/// Errors: usage for fewer than 2 starts; the last error where every start fails.
Result<Multistart> fit_ode_from_many(const OdeFitProblem& problem, OdeFitMethod method,
                                     const OdeFitSettings& settings = {},
                                     const MultistartSettings& multistart = {});

}  // namespace flexspline::estimators
