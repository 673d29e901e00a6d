#pragma once

#include <limits>
#include <string_view>

namespace flexspline::data {

inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

struct CsvNumber {
  double value = kNoNumber;
  std::string_view problem;  ///< empty: it is a finite number
  bool absent = false;       ///< an empty cell, NaN, infinity, NA, null: what a dropout leaves
};

/// A cell without spaces around it, as a finite number.
CsvNumber parse_number(std::string_view cell, bool decimal_comma);

}  // namespace flexspline::data
