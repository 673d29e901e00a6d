#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "flexspline/studies/study_config.hpp"

namespace flexspline::app {

/// A study of one data set and some methods, each an estimator under its own name.
/// Errors: a method that does not exist, options that it does not take.
Result<studies::StudyConfig> dataset_study(const std::filesystem::path& dataset,
                                           const std::vector<std::string>& methods,
                                           const std::string& train,
                                           const estimators::Options& options);

/// "a=1", "h=unity": numbers where they parse as such, else words. Errors: usage, for no "=".
Result<estimators::Options> parse_options(const std::vector<std::string>& given);

}  // namespace flexspline::app
