#pragma once

#include <functional>
#include <string_view>

namespace flexspline::studies {

/// Of a whole's progress that of a part which takes it from one share to another.
inline std::function<void(double, std::string_view)> part_of(
    const std::function<void(double, std::string_view)>& progress, double from, double to) {
  if (!progress) return {};
  return [progress, from, to](double share, std::string_view stage) {
    progress(from + share * (to - from), stage);
  };
}

}  // namespace flexspline::studies
