#pragma once

#include "command.hpp"

namespace flexspline::app {

/// The share of the largest torque below which nothing of a diagnosis is a finding.
ArgumentInfo interest_argument();

/// Its value, 0.8 % where it is not given. Errors: usage, not a share from 0.01 to 50 %.
Result<double> interest_of(const Arguments& arguments);

}  // namespace flexspline::app
