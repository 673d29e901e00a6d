#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/data/table_reader.hpp"
#include "tables/text_cell.hpp"
#include "tables/text_encoding.hpp"

namespace flexspline::data {

enum class CellKind { number, stamp, text };

/// How a text table is written, found out from its first lines.
struct CsvForm {
  SniffedEncoding encoding;
  char line_end = '\n';
  char delimiter = ',';  ///< ' ': any number of blanks
  NumberForm numbers;
  std::size_t first_line = 0;  ///< of the rows, from 0
  std::vector<std::string> names;
  std::vector<std::string> units;
  std::vector<CellKind> kinds;
  std::optional<std::int64_t> first_day;  ///< of time stamps, since 1970-01-01
  std::vector<std::string> notes;         ///< all of this in words
};

inline constexpr std::size_t kSniffedBytes = std::size_t{1} << 17U;

bool is_comment_line(std::string_view line);

/// Errors: bad_data for a text without rows of numbers, and where two ways of reading it are as
/// good as each other, with the option that states one.
Result<CsvForm> sniff_csv(std::string_view head, bool whole, const TextForm& stated);

}  // namespace flexspline::data
