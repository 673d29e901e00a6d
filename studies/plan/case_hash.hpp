#pragma once

#include <string>

#include "flexspline/studies/plan.hpp"

namespace flexspline::studies {

/// SHA-256 over what an estimate depends on: recordings by their content, which are trained on, the
/// method with its options. Cases that share it have the same estimate.
std::string fit_hash(const StudyPlan& plan, const CasePlan& one);

/// SHA-256 over everything that a case's result depends on: where its recordings come from, which
/// are trained on and held out, the seed, the method with its options, and the program.
std::string case_hash(const StudyPlan& plan, const CasePlan& one, const std::string& build_id);

/// The same of an input's artefact.
std::string input_hash(const StudyPlan& plan, const InputPlan& input, const std::string& build_id);

}  // namespace flexspline::studies
