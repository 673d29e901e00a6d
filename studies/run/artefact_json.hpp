#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "comparison/compare_recording.hpp"
#include "flexspline/core/error.hpp"
#include "inputs/prepared_input.hpp"

namespace flexspline::studies {

inline constexpr std::string_view kCaseSchema = "flexspline-case/1";
inline constexpr std::string_view kInputSchema = "flexspline-input/1";
inline constexpr std::string_view kPaperSchema = "flexspline-paper/1";

/// What became of a case.
struct CaseOutcome {
  Result<Estimate> estimate;
  std::vector<RecordingComparison> recordings;
};

/// docs/artefacts.md.
nlohmann::ordered_json case_json(const CasePlan& plan, const PreparedInput* input,
                                 const CaseOutcome& outcome);
nlohmann::ordered_json input_json(const PreparedInput& input);

/// Divides by the unit: SI to what is shown.
double shown(double si, const std::string& unit);
std::vector<double> shown(const std::vector<double>& si, const std::string& unit);
/// Amplitude in SI: nominal on the bench, half the range of the motion otherwise.
double amplitude_of(const StudyRecording& recording);

}  // namespace flexspline::studies
