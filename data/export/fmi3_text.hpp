#pragma once

#include <string_view>

namespace flexspline::data {

/// FMI 3.0 co-simulation around <name>.c; @name@ and @token@ are replaced.
extern const std::string_view kFmi3Source;

}  // namespace flexspline::data
