#pragma once

#include "flexspline/studies/case_row.hpp"
#include "run/artefact_json.hpp"

namespace flexspline::studies {

/// What is kept of a case that did not fail, beside its artefact.
CaseRow make_row(const CasePlan& plan, const PreparedInput& input, const CaseOutcome& outcome);

}  // namespace flexspline::studies
