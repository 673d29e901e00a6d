#pragma once

#include <string>
#include <vector>

#include "config/toml_section.hpp"
#include "flexspline/studies/study_config.hpp"

namespace flexspline::studies {

/// The grid that a key of a kind's table names; null after a refusal. Where there is one grid
/// alone, the key may be left out.
const Grid* named_grid(TomlSection& own, std::string_view key, const StudyConfig& study);

/// A share in percent, { value = 5, unit = "%" }, as a number in percent.
double percent_of(TomlSection& own, std::string_view key, double otherwise);

/// Refuses a study whose inputs are not all of the virtual bench: there is no truth to compare
/// with.
void need_truths(TomlSection& own, const StudyConfig& study);

/// Hold-out of every input of the bench that names none.
void hold_out_everywhere(StudyConfig& study, const std::string& grid);

/// Puts `made` in the place of the estimators that the study was written with.
EstimatorConfig made_from(const EstimatorConfig& written, const std::string& suffix);

}  // namespace flexspline::studies
