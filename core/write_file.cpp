#include "flexspline/core/write_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "flexspline/core/passing_file.hpp"

namespace flexspline {
namespace {

constexpr off_t kLargestFile = off_t{1} << 30U;

std::string reason(int code) { return std::generic_category().message(code); }

/// Closes what open gave.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }

 private:
  int number_;
};

tl::unexpected<Error> not_written(const std::filesystem::path& path, const std::string& why) {
  return failure(ErrorCode::cannot_write, "cannot write " + path.string() + ": " + why,
                 "choose a folder that can be written to and has room");
}

tl::unexpected<Error> not_read(const std::filesystem::path& path, const std::string& why) {
  return failure(ErrorCode::input_missing, "cannot read " + path.string() + ": " + why,
                 "check the path and its permissions");
}

/// 0, or the errno of the write that failed.
int write_whole(int file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(file, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

int create_whole(const std::filesystem::path& path, std::string_view content) {
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  return file.number() < 0 ? errno : write_whole(file.number(), content);
}

/// Unique among the processes and threads that write into one folder.
std::filesystem::path temporary_beside(const std::filesystem::path& path) {
  static std::atomic<unsigned> counter = 0;
  std::filesystem::path result = path;
  result.replace_filename(
      fmt::format(".{}.{}-{}.part", path.filename().string(), ::getpid(), counter++));
  return result;
}

/// Never destroyed: the program may be ended while other threads write.
std::shared_timed_mutex& writes_under_way() {
  static auto& mutex = *new std::shared_timed_mutex;
  return mutex;
}

/// What a signal handler may read: the names of the unfinished files, more than threads write at
/// once. A file that finds no slot is written all the same.
std::array<std::atomic<const char*>, 256> unfinished;
static_assert(std::atomic<const char*>::is_always_lock_free, "read in a signal handler");

int slot_for(const char* name) {
  for (std::size_t i = 0; i < unfinished.size(); ++i) {
    const char* none = nullptr;
    if (unfinished[i].compare_exchange_strong(none, name)) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace

bool file_exists(const std::filesystem::path& path) {
  std::error_code unreadable;
  return std::filesystem::exists(path, unreadable);
}

std::shared_lock<std::shared_timed_mutex> writing() { return std::shared_lock(writes_under_way()); }

UnfinishedFile::UnfinishedFile(std::filesystem::path final_path)
    : writing_(writes_under_way()),
      final_path_(std::move(final_path)),
      temporary_(temporary_beside(final_path_)),
      slot_(slot_for(temporary_.c_str())) {}

UnfinishedFile::~UnfinishedFile() {
  ::unlink(temporary_.c_str());
  if (slot_ >= 0) unfinished[static_cast<std::size_t>(slot_)] = nullptr;
}

PassingFile::PassingFile(std::filesystem::path path)
    : path_(std::move(path)), slot_(slot_for(path_.c_str())) {}

PassingFile::~PassingFile() {
  ::unlink(path_.c_str());
  if (slot_ >= 0) unfinished[static_cast<std::size_t>(slot_)] = nullptr;
}

std::error_code UnfinishedFile::finish() {
  if (::rename(temporary_.c_str(), final_path_.c_str()) == 0) return {};
  return {errno, std::generic_category()};
}

void remove_unfinished_files() {
  for (const auto& name : unfinished) {
    if (const char* path = name) ::unlink(path);
  }
}

void let_no_write_begin(std::chrono::milliseconds patience) {
  static_cast<void>(writes_under_way().try_lock_for(patience));
  remove_unfinished_files();
}

Result<void> write_file(const std::filesystem::path& path, std::string_view content) {
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  if (error) return not_written(path, error.message());
  UnfinishedFile file(path);
  if (const int code = create_whole(file.path(), content)) return not_written(path, reason(code));
  if (error = file.finish(); error) return not_written(path, error.message());
  return {};
}

Result<std::string> read_file(const std::filesystem::path& path) {
  // Without waiting for somebody to write into a pipe.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.number() < 0) return not_read(path, reason(errno));
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) return not_read(path, reason(errno));
  if (!S_ISREG(status.st_mode)) {
    return not_read(path, S_ISDIR(status.st_mode) ? "it is a folder" : "it is no regular file");
  }
  if (status.st_size > kLargestFile) {
    return not_read(path, "it has " + std::to_string(status.st_size) + " bytes, where " +
                              std::to_string(kLargestFile) + " are the most");
  }
  // One byte more than the size, so that the end of an ordinary file is seen in one pass.
  std::string content(static_cast<std::size_t>(status.st_size) + 1, '\0');
  std::size_t filled = 0;
  while (true) {
    const ssize_t got = ::read(file.number(), content.data() + filled, content.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return not_read(path, reason(errno));
    if (got == 0) break;
    filled += static_cast<std::size_t>(got);
    if (filled == content.size()) content.resize(2 * content.size());
  }
  content.resize(filled);
  return content;
}

}  // namespace flexspline
