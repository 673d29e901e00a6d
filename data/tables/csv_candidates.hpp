#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "flexspline/data/table_reader.hpp"
#include "tables/text_cell.hpp"

namespace flexspline::data {

/// A way of reading lines as rows of numbers.
struct CsvCandidate {
  char delimiter = ',';
  NumberForm numbers;
  std::size_t cells = 0;  ///< of a row
  std::size_t first = 0;  ///< line of the first row
  std::size_t rows = 0;
  double share = 0.0;  ///< of the cells from there that are numbers, time stamps or nothing
};

/// The best way: most cells are numbers, then the line above has as many cells, then most columns.
/// Nothing where no two lines look like rows.
std::optional<CsvCandidate> best_candidate(const std::vector<std::string_view>& lines,
                                           const TextForm& stated);

/// Whether the decimal mark may as well separate thousands: 1.234 beside 999.
bool is_open(const std::vector<std::string_view>& lines, const CsvCandidate& candidate);

}  // namespace flexspline::data
