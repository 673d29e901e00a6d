#pragma once

#include "flexspline/core/simulate.hpp"
#include "flexspline/estimators/uncertainty.hpp"
#include "torsion/static_fit.hpp"

namespace flexspline::estimators {

/// How the intervals of a fitted torsion law are found.
struct TorsionIntervalSettings {
  UncertaintySettings uncertainty;
  SolverSettings solver;
  IntegratorSettings integrator{};  ///< where the torsion was simulated
  bool mixed_model_bands = false;   ///< bands and verdict that do not take the class as known
};

/// The estimate of a fit that began with this one, with its intervals and bands.
/// Errors: those of torsion_intervals.
Result<Estimate> torsion_estimate(std::string estimator, TrajectoryFit fit, const StaticFit& begun,
                                  const TorsionIntervalSettings& settings);

}  // namespace flexspline::estimators
