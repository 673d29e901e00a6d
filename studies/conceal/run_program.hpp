#pragma once

#include <string>
#include <vector>

#include "flexspline/core/error.hpp"

namespace flexspline::studies {

/// Runs a program found on PATH and waits for it; gives what it wrote to its standard output.
/// Errors: input_missing where it cannot be started, numerics with the last line that it wrote to
/// its standard error where it ends with another status than 0.
Result<std::string> run_program(const std::vector<std::string>& words);

}  // namespace flexspline::studies
