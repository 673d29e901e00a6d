#pragma once

#include "run/artefact_json.hpp"

namespace flexspline::studies {

/// Estimates on the training recordings of a case. Never throws: what fails is in the result.
Result<Estimate> estimate_case(const CasePlan& plan, const Result<PreparedInput>& input);

/// Compares an estimate on the recordings that the case trains on and the held-out ones. Never
/// throws: what fails is in the outcome.
CaseOutcome compare_case(const CasePlan& plan, const Result<PreparedInput>& input,
                         const Result<Estimate>& estimate);

}  // namespace flexspline::studies
