#pragma once

#include <string>

#include "flexspline/core/error.hpp"
#include "flexspline/core/units.hpp"

namespace flexspline::app {

/// "0.2deg", "0.005 Hz": a number with a unit of one of the dimensions, in SI.
/// Errors: usage, naming the option, where there is no number, no unit or another dimension.
Result<double> parse_quantity(const std::string& option, const std::string& given,
                              Dimension dimension);

}  // namespace flexspline::app
