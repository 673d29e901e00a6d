#pragma once

#include <string>
#include <vector>

#include "flexspline/core/drive_spec.hpp"
#include "flexspline/core/error.hpp"
#include "flexspline/core/estimate.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline::estimators {

/// The constants of a rig beside a torsion law that was fitted. model: all that a simulation needs.
struct RigFit {
  RigModel model;
  std::vector<ParameterEstimate> parameters;  ///< those fitted here, SI
  std::vector<std::string> notes;
};

/// The rig of a set, its stated constants and what the training recordings tell of the others:
///   tau_m - tau_s/N - effects = J1 theta_m'' + B1 theta_m' + c tanh(theta_m'/w),  eq. (5),
///   tau_s - effects = J2 theta_l'' + B2 theta_l',  eq. (6),
/// by least squares with every constant >= 0, w the best of 61 between 0.001 and 0.3 of the largest
/// speed. Inertias are unknowns where the set does not state them. A constant is identifiable where
/// it is more than 1.96 standard deviations from zero (those of residuals that neighbours share), w
/// where no other within its range leaves as little. A specimen has no such equation, and a servo's
/// constants come from fit_servo. Errors: those of residuals().
Result<RigFit> complete_rig(const RecordingSet& set, const ModelSpec& torsion);

/// What there is of effects in a rig's model, over the recordings of a set.
struct Corrections {
  RigModel model;                  ///< without those that nearly cancel, trifles with a note
  std::vector<std::string> notes;  ///< what was left out or noted
};

/// An effect whose part in every torque is below 0.2 % of the largest (rms) is noted as too small
/// to be named. Two whose parts in a torque nearly cancel (their sum is less than a fifth of the
/// smaller one) are left out: the recordings tell their sum and neither of the two.
Result<Corrections> judge_corrections(const RecordingSet& set, RigModel model);

}  // namespace flexspline::estimators
