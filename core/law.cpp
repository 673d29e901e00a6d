#include "flexspline/core/law.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

namespace flexspline {

Result<std::unique_ptr<Law>> make_law(const LawSpec& spec) {
  const auto rows = laws();
  const auto row = std::ranges::find(rows, std::string_view(spec.law), &LawRow::id);
  if (row == rows.end()) {
    return failure(ErrorCode::bad_data, fmt::format("there is no law '{}'", spec.law),
                   "flexspline list laws names them");
  }
  if (!(spec.scale > 0.0)) {
    return failure(ErrorCode::bad_data,
                   fmt::format("the scale of law {} is {}", spec.law, spec.scale),
                   "a scale is positive");
  }
  return row->make(spec);
}

}  // namespace flexspline
