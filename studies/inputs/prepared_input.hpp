#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flexspline/core/effect.hpp"
#include "flexspline/core/recording.hpp"
#include "flexspline/data/bench.hpp"
#include "flexspline/studies/plan.hpp"

namespace flexspline::studies {

/// What only the virtual bench knows of a recording.
struct KnownTruth {
  Motion motion;
  std::vector<double> torque;
};

/// A recording as a study uses it.
struct StudyRecording {
  TorsionRecord record;
  std::optional<KnownTruth> truth;  ///< absent for data sets
};

/// All recordings of one input and replicate.
struct PreparedInput {
  InputPlan plan;
  Rig rig = Rig::locked;
  std::string says;  ///< what the input is, in a sentence
  std::string source;
  std::string license;
  DisplayUnits units;
  std::optional<data::BenchTruth> truth;  ///< absent for data sets
  std::vector<StudyRecording> recordings;

  const StudyRecording* find(std::string_view id) const;
};

/// Makes or takes the recordings of an input.
/// Errors: what the bench or the torsion view of a recording refuses, with the recording's id.
Result<PreparedInput> prepare_input(const StudyPlan& study, const InputPlan& input);

}  // namespace flexspline::studies
