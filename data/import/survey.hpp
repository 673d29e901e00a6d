#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "flexspline/data/table_reader.hpp"

namespace flexspline::data {

/// A column of a file, looked at from its first row to its last.
struct ColumnSurvey {
  TableColumn column;  ///< its unit may have stood behind its name
  bool unit_in_name = false;
  std::size_t present = 0;  ///< cells with a number
  double low = 0.0, high = 0.0;
  double first = 0.0, last = 0.0;
  std::size_t falls = 0;    ///< cells below the one before
  std::size_t repeats = 0;  ///< cells equal to the one before
  bool whole = true;        ///< every number is a whole one
  std::vector<double> sample;

  bool moves() const { return present > 0 && high > low; }
};

/// A table of a file that is a part of a joined one.
struct TablePart {
  std::size_t index = 0;                          ///< of the table in its file
  std::size_t clock = 0;                          ///< its column of time
  double clock_factor = 1.0, clock_offset = 0.0;  ///< to the joined clock
  double longest_step = 0.0;                      ///< on the joined clock: what is longer is a gap
  std::vector<std::size_t> columns;               ///< of the table, in the order of the joined one
};

struct TableSurvey {
  std::filesystem::path file;
  std::string reader;
  std::string path;       ///< of the table inside the file
  std::size_t index = 0;  ///< of the table in its file
  std::vector<ColumnSurvey> columns;
  std::vector<TablePart> parts;  ///< of a joined table, the one whose clock it has first
  std::size_t rows = 0;
  std::size_t stride = 1;  ///< rows between two of the samples
  std::vector<std::string> notes;
  std::uintmax_t bytes = 0;  ///< of the file, when it was looked at
  std::filesystem::file_time_type changed{};

  /// Errors: bad_data, where the file is not what it was then.
  Result<void> check_same_file() const;
  /// "file", or "file, table 'path'".
  std::string words() const;
};

/// Every table of a file that has numbers. Memory does not grow with its rows.
/// Errors: those of read_tables.
Result<std::vector<TableSurvey>> survey_file(const std::filesystem::path& file,
                                             const TableRequest& request);

/// The step of time that is usual, in the column's unit: the median over the rises.
double usual_step(const TableSurvey& table, std::size_t column);

}  // namespace flexspline::data
