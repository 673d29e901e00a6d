#pragma once

#include <string_view>

#include "flexspline/core/error.hpp"

namespace flexspline {

/// How deep brackets, or the parts of a dotted key, may nest in a file: parsers, copies and
/// destructors of trees call themselves once a level.
inline constexpr int kDeepestNesting = 64;

/// Looks at a TOML or JSON text before a parser does; in linear time, in no memory.
/// Errors: bad_data with the line on which it nests deeper than that.
Result<void> check_nesting(std::string_view text);

}  // namespace flexspline
