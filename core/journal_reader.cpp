#include <algorithm>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "journal_line.hpp"

namespace flexspline {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 20U;

tl::unexpected<Error> not_read(const std::filesystem::path& file, int code) {
  return failure(ErrorCode::input_missing,
                 "cannot read " + file.string() + ": " + std::generic_category().message(code),
                 "check the path and its permissions");
}

/// Reads a file from where it is told; closes it.
class Source {
 public:
  explicit Source(const std::filesystem::path& file)
      : number_(::open(file.c_str(), O_RDONLY | O_CLOEXEC)), code_(number_ < 0 ? errno : 0) {}
  ~Source() {
    if (number_ >= 0) ::close(number_);
  }
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  int code() const { return code_; }
  /// How many bytes it gave, 0 at the end or after a failure.
  std::size_t read(char* to, std::size_t size, std::uint64_t offset) {
    ssize_t got = -1;
    do {
      got = ::pread(number_, to, size, static_cast<off_t>(offset));
    } while (got < 0 && errno == EINTR);
    if (got < 0) code_ = errno;
    return got > 0 ? static_cast<std::size_t>(got) : 0;
  }

 private:
  int number_;
  int code_;
};

bool is_head(std::string_view record) { return record == kJournalSchema; }

}  // namespace

Result<JournalScan> scan_journal(const std::filesystem::path& file,
                                 const std::function<void(JournalFields, RecordPlace)>& visit) {
  Source source(file);
  if (source.code() != 0) return not_read(file, source.code());
  JournalScan scan;
  std::string held;
  std::uint64_t at = 0;  // of held's first byte in the file
  bool headed = false;
  while (true) {
    const std::size_t before = held.size();
    held.resize(before + kChunk);
    const std::size_t got = source.read(held.data() + before, kChunk, at + before);
    held.resize(before + got);
    if (got == 0) break;
    std::size_t begin = 0;
    for (std::size_t end = held.find('\n', before); end != std::string::npos;
         end = held.find('\n', begin)) {
      const std::string_view line = std::string_view(held).substr(begin, end - begin);
      const RecordPlace place{at + begin, line.size()};
      const std::string_view record = checked_record(line);
      begin = end + 1;
      if (record.data() == nullptr) {
        scan.damaged.push_back(place);
      } else if (!headed && record.starts_with("flexspline-journal/") && !is_head(record)) {
        return failure(ErrorCode::bad_data,
                       file.string() + " is of schema " + std::string(record) + ", not " +
                           std::string(kJournalSchema),
                       "read it with the version that wrote it");
      } else if (!is_head(record)) {
        ++scan.records;
        visit(fields_of(record), place);
      }
      headed = true;
    }
    held.erase(0, begin);
    at += begin;
  }
  if (source.code() != 0) return not_read(file, source.code());
  scan.torn = !held.empty();
  return scan;
}

Result<std::string> read_record(const std::filesystem::path& file, RecordPlace place) {
  Source source(file);
  if (source.code() != 0) return not_read(file, source.code());
  std::string line(place.size, '\0');
  std::size_t filled = 0;
  while (filled < line.size()) {
    const std::size_t got =
        source.read(line.data() + filled, line.size() - filled, place.offset + filled);
    if (got == 0) break;
    filled += got;
  }
  const std::string_view record = checked_record(line);
  if (source.code() != 0) return not_read(file, source.code());
  if (record.data() == nullptr) {
    return failure(ErrorCode::bad_data,
                   file.string() + ": the checksum of the record at byte " +
                       std::to_string(place.offset) + " does not hold",
                   "run the study again: its case is computed once more");
  }
  return std::string(record);
}

std::vector<std::filesystem::path> journals_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".journal") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace flexspline
