#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/core/error.hpp"

namespace flexspline::data {

/// A column of numbers as a file has it. Texts are UTF-8.
struct TableColumn {
  std::string name;
  std::string unit;                 ///< as the file states it; empty where it does not
  bool clock = false;               ///< the file marks it as the time of the others
  std::optional<double> epoch_s{};  ///< of time stamps: their zero, in s since 1970
};

/// A table of a file, before its rows.
struct TableHead {
  std::string path;  ///< inside the file, "a/b"; empty where the file is one table
  std::vector<TableColumn> columns;
  std::vector<std::string> notes;  ///< how it was understood, and what was left out
};

/// Who takes the tables of a file, one after the other.
class TableSink {
 public:
  virtual ~TableSink() = default;
  /// Indices of the columns whose rows are wanted, rising; none: the table is passed over.
  virtual std::vector<std::size_t> begin(const TableHead& head) = 0;
  /// Some rows of the columns that are wanted, all of one length; what is absent is NaN.
  virtual void rows(std::span<const std::vector<double>> columns) = 0;
  /// Of the table at hand or of the file: what was found on the way.
  virtual void note(const std::string& text) = 0;
};

/// What a file may ask for; beyond it, it is refused.
struct TableLimits {
  std::size_t columns = 4096;  ///< of one table
  std::size_t rows = 100'000'000;
  std::size_t tables = 4096;
  std::size_t depth = 32;                            ///< of structs and groups in each other
  std::size_t memory_bytes = std::size_t{4} << 30U;  ///< of a reader by others
  double silence_s = 120.0;                          ///< of a reader by others, then it is ended
};

/// What a person states of a text table, where it cannot be found out.
struct TextForm {
  char delimiter = 0;  ///< 0: found out
  char decimal = 0;
  int header_line = 0;  ///< 1-based
};

struct TableRequest {
  TableLimits limits;
  TextForm text;
};

/// A row of the catalogue of readers, one file each in data/table_readers.
struct TableReaderRow {
  std::string_view id;
  std::string_view says;
  bool by_others = false;  ///< uses a parser by others: runs in a process of its own
  /// By the first bytes of a file, 4096 or all.
  bool (*knows)(std::string_view head) = nullptr;
  /// Streams the tables of a file. Errors: bad_data, with the place where it stands.
  Result<void> (*read)(const std::filesystem::path&, const TableRequest&, TableSink&) = nullptr;
};

std::span<const TableReaderRow> table_readers();

/// The reader for a file, by its content. Errors: input_missing for what is no regular file;
/// bad_data for forms that nobody reads, with the way out.
Result<const TableReaderRow*> reader_of(const std::filesystem::path& file);

/// Streams the tables of a file, whatever reads it; a reader by others in a process of its own, so
/// that its crash is an error of this file. Errors: as reader_of; bad_data; a file that has changed
/// while it was read.
Result<void> read_tables(const std::filesystem::path& file, const TableRequest& request,
                         TableSink& sink);

}  // namespace flexspline::data
