#include "flexspline/core/effect.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace flexspline {

Result<const EffectRow*> find_effect(std::string_view id) {
  const auto rows = effects();
  const auto row = std::ranges::find(rows, id, &EffectRow::id);
  if (row == rows.end()) {
    return failure(ErrorCode::bad_data, fmt::format("there is no effect '{}'", id),
                   "flexspline list effects names them");
  }
  return &*row;
}

}  // namespace flexspline
