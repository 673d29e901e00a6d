#include "flexspline/core/law.hpp"

#include <algorithm>
#include <cmath>
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
  if (!std::ranges::all_of(spec.coefficients, [](double c) { return std::isfinite(c); })) {
    return failure(ErrorCode::bad_data,
                   fmt::format("a coefficient of law {} is not a number", spec.law),
                   "coefficients are finite");
  }
  return row->make(spec);
}

}  // namespace flexspline
