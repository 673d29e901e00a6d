#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "flexspline/core/error.hpp"

namespace flexspline {

/// A journal is a text file that only grows: a line a record, "<CRC-32 of the rest, 8 hex digits>
/// TAB field TAB field …". Fields hold neither tab nor line end. A line whose checksum does not
/// hold is no record; what follows the last line end was never finished.
inline constexpr std::string_view kJournalSchema = "flexspline-journal/1";

using JournalFields = std::span<const std::string_view>;

/// Where a record lies in its file, without its line end.
struct RecordPlace {
  std::uint64_t offset = 0;
  std::uint64_t size = 0;
};

/// What a file holds beside its records.
struct JournalScan {
  std::size_t records = 0;
  std::vector<RecordPlace> damaged;  ///< lines whose checksum does not hold
  bool torn = false;                 ///< it ends within a line
};

/// Every record of a file in its order, the first line (the schema) apart. The fields live as long
/// as the call of visit. Errors: input_missing; bad_data for a file of another schema.
Result<JournalScan> scan_journal(const std::filesystem::path& file,
                                 const std::function<void(JournalFields, RecordPlace)>& visit);

/// One record as text, its fields apart by tabs. Errors: input_missing; bad_data where its checksum
/// does not hold.
Result<std::string> read_record(const std::filesystem::path& file, RecordPlace place);

/// The fields of a record's text.
std::vector<std::string_view> fields_of(std::string_view record);

/// "*.journal" of a folder, in alphabetical order.
std::vector<std::filesystem::path> journals_in(const std::filesystem::path& folder);

/// The only writer of one journal. No two processes write one file: it is locked, and its name
/// holds the host's, so that no lock has to hold between hosts.
class JournalWriter {
 public:
  /// Opens the first of <folder>/<host>-1.journal, -2, … that nobody writes, made where there is
  /// none. What an interrupted writer left behind the last line end is cut off.
  /// Errors: cannot_write.
  static Result<JournalWriter> open(const std::filesystem::path& folder);

  JournalWriter(JournalWriter&& other) noexcept
      : file_(std::exchange(other.file_, -1)), path_(std::move(other.path_)) {}
  JournalWriter& operator=(JournalWriter&&) = delete;
  ~JournalWriter();

  /// In one write; where there is no room for all of it, the file is as long as before.
  /// Errors: cannot_write.
  Result<void> append(JournalFields fields);

  const std::filesystem::path& path() const { return path_; }

  /// Takes the records out of a folder's journals for which keep is false, and every damaged line,
  /// into "<name>.journal.stale" beside them. Nothing happens where somebody writes one of them:
  /// gives whether it was done. Errors: cannot_write.
  static Result<bool> set_aside(const std::filesystem::path& folder,
                                const std::function<bool(JournalFields)>& keep);

 private:
  JournalWriter(int file, std::filesystem::path path) : file_(file), path_(std::move(path)) {}
  static Result<JournalWriter> open_one(const std::filesystem::path& path, bool& taken);

  int file_ = -1;
  std::filesystem::path path_;
};

}  // namespace flexspline
