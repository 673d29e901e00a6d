#pragma once

#include <map>
#include <string>
#include <vector>

#include "flexspline/core/estimate.hpp"
#include "flexspline/studies/metric.hpp"
#include "inputs/prepared_input.hpp"

namespace flexspline::studies {

/// One recording against the simulation of one estimate, displacement-driven, eq. (4).
struct RecordingComparison {
  std::string id;
  bool trained = false;
  std::map<std::string, double> metrics;  ///< by id of the catalogue; SI, or percent
  bool outside_domain = false;            ///< more than 1 % of it beyond 102 % of what was trained
  std::vector<double> motion;             ///< decimated: one steady cycle, else the whole. SI
  std::vector<double> measured;
  std::vector<double> simulated;
};

/// Virtual recordings are simulated along the bench's true motion, after its run-up cycle, others
/// along the motion reconstructed from what was measured. Where the estimate has a zero of the
/// motion for each recording (parameters zero[<id>]), a recording without one gets its own by
/// one-dimensional least squares.
/// Errors: a motion that cannot be reconstructed, a model that cannot be simulated.
Result<RecordingComparison> compare_recording(const Estimate& estimate,
                                              const StudyRecording& recording, bool trained);

}  // namespace flexspline::studies
