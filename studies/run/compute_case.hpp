#pragma once

#include "run/artefact_json.hpp"

namespace flexspline::studies {

/// Estimates on the training recordings of a case. What fails is in the result, but for
/// std::bad_alloc.
Result<Estimate> estimate_case(const CasePlan& plan, const Result<PreparedInput>& input);

/// Compares an estimate on the recordings that the case trains on and the held-out ones. The
/// same.
CaseOutcome compare_case(const CasePlan& plan, const Result<PreparedInput>& input,
                         const Result<Estimate>& estimate);

}  // namespace flexspline::studies
