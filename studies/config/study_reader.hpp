#pragma once

#include <string>
#include <vector>

#include "config/toml_section.hpp"
#include "flexspline/studies/study_config.hpp"

namespace flexspline::studies {

/// Parts of a study, each read from its own table; what is wrong goes to the section's findings.
/// What is not given is as in `bench`.
BenchConfig read_bench(TomlSection& section, BenchConfig bench = {});
Grid read_grid(TomlSection& section);
InputConfig read_input(TomlSection& section, const StudyConfig& study,
                       const std::filesystem::path& data_root);
/// Model files are found from model_root.
EstimatorConfig read_estimator(TomlSection& section, const StudyConfig& study,
                               const std::filesystem::path& model_root);

ContrastConfig read_contrast(TomlSection& section, const StudyConfig& study);

/// Refuses an id that was given before, or that cannot be part of a file name.
void check_id(TomlSection& section, const std::string& id, const std::vector<std::string>& before);

}  // namespace flexspline::studies
