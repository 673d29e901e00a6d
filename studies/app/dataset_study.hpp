#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "command.hpp"
#include "flexspline/studies/study_config.hpp"

namespace flexspline::app {

/// A study of one data set and some methods, each an estimator under its own name.
/// Errors: a method that does not exist, options that it does not take.
Result<studies::StudyConfig> dataset_study(const std::filesystem::path& dataset,
                                           const std::vector<std::string>& methods,
                                           const std::string& train,
                                           const estimators::Options& options);

/// --rows of the arguments: at most so many of a recording, or all.
/// Errors: usage, where it is neither "all" nor a whole number from 16 on.
Result<std::size_t> rows_of(const Arguments& arguments);

/// The argument --rows of a command's row.
ArgumentInfo rows_argument();

/// "a=1", "h=unity": numbers where they parse as such, else words. Errors: usage, for no "=".
Result<estimators::Options> parse_options(const std::vector<std::string>& given);

}  // namespace flexspline::app
