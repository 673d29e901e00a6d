#pragma once

#include <nlohmann/json_fwd.hpp>

#include "flexspline/studies/study_config.hpp"

namespace flexspline::studies {

/// What a result depends on, in one canonical form: the same meaning gives the same text.
nlohmann::ordered_json to_json(const BenchConfig& bench);
nlohmann::ordered_json to_json(const std::vector<Loop>& loops);
nlohmann::ordered_json to_json(const estimators::Options& options);
nlohmann::ordered_json to_json(const estimators::GivenModel& given);
nlohmann::ordered_json to_json(const StudyConfig& study);

}  // namespace flexspline::studies
