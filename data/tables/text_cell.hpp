#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace flexspline::data {

/// Blanks and one pair of quotes taken off.
std::string_view bare_cell(std::string_view cell);

/// Cells of a line; a delimiter inside quotes separates nothing. ' ' stands for any number of
/// blanks.
void split_text(std::string_view line, char delimiter, std::vector<std::string_view>& cells);

/// An empty cell, NaN, NA, null, #NV, ---: what loggers and spreadsheets write for nothing.
bool is_nothing(std::string_view bare);

/// How numbers are written.
struct NumberForm {
  char decimal = '.';
  bool grouped = false;  ///< 1.234.567,8: groups of three digits are taken
};

/// A bare cell as a finite number; nothing where it is none.
std::optional<double> text_number(std::string_view bare, const NumberForm& form);

/// 1,234,567 or 1'234'567.8: digits in groups of three.
bool is_grouped(std::string_view bare, char decimal);

}  // namespace flexspline::data
