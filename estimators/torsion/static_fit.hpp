#pragma once

#include <vector>

#include "flexspline/core/remembered.hpp"
#include "torsion/free_terms.hpp"
#include "torsion/trajectory_fit.hpp"

namespace flexspline::estimators {

struct StaticFitSettings {
  std::size_t samples = 3000;  ///< most residuals of one recording
  std::size_t intervals = 0;   ///< of f and of g^-1, even, on each side; 0: chosen by the data
  AllowedTerms allowed;
  SolverSettings solver;
};

/// A fit of eq. (4), tau = f(phi) + g^-1(phi'/h(phi)) + J phi'' + offset at t - delay, along the
/// motion as measured and smoothed. No differential equation is integrated.
struct StaticFit {
  std::vector<PreparedRecord> records;  ///< with the noise that the fit weighed by
  TermDecision decision;
  TrajectoryFit fit;
  Content content;  ///< what all of this depends on
  bool misses;      ///< leaves more than 1.5 times the noise of the recordings
};

/// Decides which terms are free, chooses the class of f and g^-1 unless intervals are given, and
/// fits. Where the fit misses more than the noise, the misfit counts into the noise and it is
/// repeated. Made once for all estimators of a process that ask for the same.
/// Errors: bad_data where no recording is given or the motion passes too little of its range both
/// ways; numerics where a recording cannot be reconstructed or has fewer samples than unknowns.
Result<StaticFit> fit_static(const std::vector<TorsionRecord>& records,
                             const StaticFitSettings& settings);

}  // namespace flexspline::estimators
