#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/data/dataset.hpp"

namespace flexspline::data {

/// What a column may hold besides numbers of its range.
enum class CsvRole {
  value,       ///< an empty cell or NaN where the row is marked as spoiled
  increasing,  ///< every number greater than the one before
  flag,        ///< 0 or 1
  valid,       ///< 0 or 1; 0 marks the row as spoiled
};

/// A column that is to be read.
struct CsvColumn {
  std::string name;
  CsvRole role = CsvRole::value;
  double low = -std::numeric_limits<double>::infinity();  ///< in the unit of the file
  double high = std::numeric_limits<double>::infinity();
  std::string limit;  ///< the range in words, for a message
  std::string named;  ///< where and as what it is named, for a message
};

/// The columns of a table that were asked for. Row i stands on line i + 2. What could not be read
/// is NaN: with a finding, or where the row is marked as spoiled.
struct CsvTable {
  std::vector<std::string> header;           ///< all columns of the file, in its order
  std::vector<std::vector<double>> columns;  ///< as they were asked for
  std::size_t rows = 0;
};

/// Reads the columns that are wanted, line by line. The first line names the columns, separated by
/// commas, semicolons or tabs. Byte-order mark, CRLF, quotes, spaces around cells and empty lines
/// at the end are taken as they come; separated by semicolons, numbers may have a decimal comma,
/// with a note; a header that is not UTF-8 is read as Latin-1, with a note.
/// Findings: a file that cannot be read, no header, a column twice or missing, a row with another
/// number of cells, a cell that is not a finite number of its column's range, a value that does not
/// increase where it has to; more than 4096 columns, 100 million rows or a line of 1 MiB. After 20
/// of them in a file the rest is counted.
CsvTable read_csv(const std::filesystem::path& file, const std::vector<CsvColumn>& wanted,
                  DatasetReading& reading);

}  // namespace flexspline::data
