#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexspline::data {

/// What makes a line of a table foreign, and what to write instead.
struct Foreign {
  std::string problem;
  std::string remedy;
};

/// Of a header in which not every column that is wanted was found: a comment, numbers without
/// names, names separated by blanks, a hint of a spreadsheet.
std::optional<Foreign> foreign_header(std::string_view line, std::size_t cells);

/// Of a row with a cell that is no number: a comment, or a row of units below the header.
std::optional<Foreign> foreign_row(std::string_view line, int number, bool any_number);

/// Of a cell that is no number: a date, or a number with its unit.
std::optional<std::string> foreign_cell(std::string_view cell);

}  // namespace flexspline::data
