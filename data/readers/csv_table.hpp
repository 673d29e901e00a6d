#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "flexspline/data/dataset.hpp"

namespace flexspline::data {

/// A table of comma (semicolon, tab) separated numbers. Row i of every column stands on line i + 2.
/// A cell that could not be read is NaN, and has a finding.
struct CsvTable {
  std::vector<std::string> header;           ///< all columns of the file, in its order
  std::vector<std::vector<double>> columns;  ///< as the header; empty for columns not asked for
  std::size_t rows = 0;
};

/// The columns that are to be read.
struct CsvColumns {
  std::vector<std::string> names;
  std::string increasing;  ///< the one of them that has to increase from row to row; may be empty
};

/// Reads the columns that are wanted. The first line names the columns. Byte-order mark, CRLF,
/// quotes, spaces around cells and empty lines at the end are taken as they come; separated by
/// semicolons, numbers may have a decimal comma, with a note.
/// Findings: no header, a column twice, a row with another number of cells, a cell that is not a
/// finite number, a value that does not increase where it has to. After 20 of them in a file the
/// rest is counted.
CsvTable parse_csv(std::string_view text, const CsvColumns& wanted, const std::string& file,
                   DatasetReading& reading);

}  // namespace flexspline::data
