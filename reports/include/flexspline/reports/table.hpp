#pragma once

#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace flexspline::reports {

/// Words, or a number; NaN is a number that does not exist and is shown as a dash.
using Cell = std::variant<std::string, double>;

struct Column {
  std::string name;
  std::string unit;  ///< empty: none
  int digits = 3;    ///< significant digits shown to a person, 0: a count; files keep all of them
  /// Larger numbers are shown as "diverged"; files keep them.
  double most = std::numeric_limits<double>::infinity();
};

/// Errors in percent of their signal: one that is larger than the signal diverged.
Column errors_of_signal(std::string name);

/// A table, from which the page, CSV, Markdown and LaTeX are all written.
struct Table {
  std::string id;  ///< also the name of its files: lower-case letters, digits, hyphens
  std::string caption;
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;
};

/// Whether a column holds numbers, in some row at least.
bool is_numeric(const Table& table, std::size_t column);

/// The table without columns of numbers none of which exists.
Table without_empty_columns(Table table);

/// RFC 4180; names with their units in the first line; numbers in full.
std::string csv_of(const Table& table);
/// GitHub's Markdown, with a row of units.
std::string markdown_of(const Table& table);
/// A booktabs table environment.
std::string latex_of(const Table& table);

/// A cell as a person sees it.
std::string shown(const Cell& cell, const Column& column);

}  // namespace flexspline::reports
