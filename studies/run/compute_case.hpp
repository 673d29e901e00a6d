#pragma once

#include "run/artefact_json.hpp"

namespace flexspline::studies {

/// Estimates on the training recordings and compares on those and the held-out ones. Never throws:
/// what fails is in the outcome.
CaseOutcome compute_case(const CasePlan& plan, const Result<PreparedInput>& input);

}  // namespace flexspline::studies
