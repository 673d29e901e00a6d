#pragma once

#include <algorithm>
#include <vector>

namespace flexspline::studies {

/// The middle of the values in their order, the upper one of two; 0 of none.
inline double middle(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, at);
  return *at;
}

/// The value below which a share of them lies, the lower one of two; 0 of none.
inline double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

}  // namespace flexspline::studies
