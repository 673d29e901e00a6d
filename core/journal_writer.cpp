#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "flexspline/core/write_file.hpp"
#include "journal_line.hpp"

namespace flexspline {
namespace {

namespace fs = std::filesystem;

constexpr int kMostWriters = 10000;  // on one host

tl::unexpected<Error> not_written(const fs::path& path, int code) {
  return failure(ErrorCode::cannot_write,
                 "cannot write " + path.string() + ": " + std::generic_category().message(code),
                 "choose a folder that can be written to and has room");
}

std::string host_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "host";
  std::string host(name.data());
  for (char& letter : host) {
    const bool plain = (letter >= '0' && letter <= '9') || (letter >= 'a' && letter <= 'z') ||
                       (letter >= 'A' && letter <= 'Z') || letter == '-';
    if (!plain) letter = '_';
  }
  return host.empty() ? "host" : host;
}

/// Whether the path still leads to the open file: it may have been replaced before it was locked.
bool leads_to(const fs::path& path, int file) {
  struct stat own {};
  struct stat there {};
  return ::fstat(file, &own) == 0 && ::stat(path.c_str(), &there) == 0 &&
         own.st_ino == there.st_ino && own.st_dev == there.st_dev;
}

/// Length up to and with the last line end.
off_t whole_length(int file, off_t length) {
  std::array<char, 4096> chunk{};
  while (length > 0) {
    const off_t from = std::max<off_t>(0, length - static_cast<off_t>(chunk.size()));
    const auto size = static_cast<std::size_t>(length - from);
    if (::pread(file, chunk.data(), size, from) != static_cast<ssize_t>(size)) return length;
    const auto last = std::string_view(chunk.data(), size).rfind('\n');
    if (last != std::string_view::npos) return from + static_cast<off_t>(last) + 1;
    length = from;
  }
  return 0;
}

int put(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

std::string head_line() {
  const std::array<std::string_view, 1> head = {kJournalSchema};
  return journal_line(head);
}

}  // namespace

Result<JournalWriter> JournalWriter::open_one(const fs::path& path, bool& taken) {
  taken = false;
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file < 0) return not_written(path, errno);
  JournalWriter writer(file, path);
  if (::flock(file, LOCK_EX | LOCK_NB) != 0 || !leads_to(path, file)) {
    taken = true;
    return writer;
  }
  struct stat status {};
  if (::fstat(file, &status) != 0) return not_written(path, errno);
  const off_t whole = whole_length(file, status.st_size);
  if (whole != status.st_size && ::ftruncate(file, whole) != 0) return not_written(path, errno);
  if (whole > 0) return writer;
  if (const int code = put(file, head_line()); code != 0) return not_written(path, code);
  return writer;
}

Result<JournalWriter> JournalWriter::open(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return not_written(folder, error.value());
  const std::string host = host_name();
  for (int k = 1; k <= kMostWriters; ++k) {
    bool taken = false;
    auto writer = open_one(folder / (host + "-" + std::to_string(k) + ".journal"), taken);
    if (!writer || !taken) return writer;
  }
  return not_written(folder, EBUSY);
}

JournalWriter::~JournalWriter() {
  if (file_ < 0) return;
  ::fdatasync(file_);
  ::close(file_);
}

Result<void> JournalWriter::append(JournalFields fields) {
  const std::string line = journal_line(fields);
  const auto whole = writing();
  struct stat status {};
  if (::fstat(file_, &status) != 0) return not_written(path_, errno);
  if (status.st_nlink == 0) return not_written(path_, ENOENT);  // the folder was taken away
  const int code = put(file_, line);
  if (code == 0) return {};
  if (::ftruncate(file_, status.st_size) != 0) return not_written(path_, errno);
  return not_written(path_, code);
}

namespace {

/// Parts one file: first what goes, then what stays, so that killed in between nothing is lost.
Result<void> part(const fs::path& path, const std::function<bool(JournalFields)>& keep) {
  UnfinishedFile kept(path);
  const fs::path stale = path.string() + ".stale";
  std::ofstream stay(kept.path(), std::ios::binary | std::ios::trunc);
  std::ofstream go(stale, std::ios::binary | std::ios::app);
  stay << head_line();
  const auto scan = scan_journal(path, [&](JournalFields fields, RecordPlace) {
    (keep(fields) ? stay : go) << journal_line(fields);
  });
  if (!scan) return tl::unexpected(scan.error());
  std::ifstream whole(path, std::ios::binary);
  for (const RecordPlace& place : scan->damaged) {
    std::string line(place.size, '\0');
    whole.seekg(static_cast<std::streamoff>(place.offset));
    whole.read(line.data(), static_cast<std::streamsize>(line.size()));
    go << line << '\n';
  }
  go.close();
  stay.close();
  std::error_code error;
  if (fs::file_size(stale, error) == 0) fs::remove(stale, error);
  if (!stay || !go) return not_written(path, errno);
  error = kept.finish();
  if (error) return not_written(path, error.value());
  return {};
}

/// Whether a file holds anything that goes.
Result<bool> has_stale(const fs::path& path, const std::function<bool(JournalFields)>& keep) {
  bool found = false;
  const auto scan = scan_journal(
      path, [&](JournalFields fields, RecordPlace) { found = found || !keep(fields); });
  if (!scan) return tl::unexpected(scan.error());
  return found || !scan->damaged.empty();
}

}  // namespace

Result<bool> JournalWriter::set_aside(const fs::path& folder,
                                      const std::function<bool(JournalFields)>& keep) {
  const auto files = journals_in(folder);
  std::vector<JournalWriter> locks;
  for (const fs::path& path : files) {
    bool taken = false;
    auto writer = open_one(path, taken);
    if (!writer) return tl::unexpected(writer.error());
    if (taken) return false;
    locks.push_back(std::move(*writer));
  }
  for (const fs::path& path : files) {
    const auto stale = has_stale(path, keep);
    if (!stale) return tl::unexpected(stale.error());
    if (!*stale) continue;
    if (const auto parted = part(path, keep); !parted) return tl::unexpected(parted.error());
  }
  return true;
}

}  // namespace flexspline
