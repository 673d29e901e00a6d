#pragma once

#include <array>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/estimate.hpp"
#include "flexspline/core/recording.hpp"
#include "flexspline/estimators/midpoint_locus.hpp"
#include "flexspline/studies/study_config.hpp"

namespace flexspline::studies {

/// The paper's experiment on the virtual bench: its recording is not public, Table I is all that is
/// left of it.
struct PaperExperiment {
  Recording recording;   ///< motor angle and torque as the sensors show them, SI
  TorsionRecord record;  ///< the same as torque over torsion
  estimators::MidpointLocus locus;
  Estimate estimate;  ///< by the paper's own method
};

/// Errors: the truth table_i, the bench or the method midpoint_polynomial fail.
Result<PaperExperiment> repeat_experiment(const StudyConfig& study);

/// A coefficient in Table I's units with its standard deviation, as the method names and gives it;
/// NaN where it does not.
struct Recovered {
  double value;
  double std;
};
std::array<Recovered, 5> recovered_coefficients(const Estimate& estimate, char letter);

}  // namespace flexspline::studies
