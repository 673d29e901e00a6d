#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "readers/csv_table.hpp"

namespace flexspline::data {

inline constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();

/// A cell without the quotes and spaces around it.
struct CsvCell {
  std::string_view text;
  std::size_t column;  ///< 1-based, of its first character in the line
};

void split_cells(std::string_view line, char separator, std::vector<CsvCell>& cells);

bool is_blank(std::string_view line);

/// Reads a row as nearly all are: as many cells as columns, every one that is wanted a plain number
/// of its range. slots: by column of the file, which of the wanted it is, or kNowhere. False: look
/// closer, cell by cell.
bool read_plain_row(std::string_view line, char separator, const std::vector<std::size_t>& slots,
                    const std::vector<CsvColumn>& wanted, std::vector<double>& values);

}  // namespace flexspline::data
