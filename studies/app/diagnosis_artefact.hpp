#pragma once

#include <nlohmann/json_fwd.hpp>

#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::app {

/// A diagnosis with the program that made it: build_id and versions beside what
/// studies::to_json gives.
nlohmann::ordered_json diagnosis_artefact(const studies::Diagnosis& diagnosis);

}  // namespace flexspline::app
