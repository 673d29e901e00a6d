#pragma once

#include <string>

#include "plan/variant_plan.hpp"

namespace flexspline::studies {

/// SHA-256 over what an estimate depends on but for the seed: recordings by their content, which
/// are trained on, the method with its options.
std::string fit_hash(const StudyPlan& plan, const StudyConfig& study, const InputConfig& input,
                     const EstimatorConfig& estimator, const CellPlan& cell);

/// The same over what the comparison of an estimate depends on beyond it.
std::string case_hash(const CellPlan& cell);

/// SHA-256 over everything that an input's artefact depends on.
std::string input_hash(const StudyPlan& plan, const InputPlan& input, const std::string& build_id);

}  // namespace flexspline::studies
