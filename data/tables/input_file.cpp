#include "tables/input_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace flexspline::data {
namespace {

tl::unexpected<Error> not_read(const std::filesystem::path& path, const std::string& why) {
  return failure(ErrorCode::input_missing, "cannot read " + path.string() + ": " + why,
                 "check the path and its permissions");
}

std::string reason(int code) { return std::generic_category().message(code); }

}  // namespace

Result<InputFile> InputFile::open(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return not_read(path, reason(errno));
  InputFile input(file, path);
  if (::fstat(file, &input.status_) != 0) return not_read(path, reason(errno));
  if (!S_ISREG(input.status_.st_mode)) return not_read(path, "it is no regular file");
  return input;
}

InputFile::InputFile(InputFile&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      path_(std::move(other.path_)),
      status_(other.status_) {}

InputFile::~InputFile() {
  if (file_ >= 0) ::close(file_);
}

Result<std::size_t> InputFile::read(std::size_t from, char* to, std::size_t count) const {
  std::size_t got = 0;
  while (got < count) {
    const ssize_t more = ::pread(file_, to + got, count - got, static_cast<off_t>(from + got));
    if (more < 0 && errno == EINTR) continue;
    if (more < 0) return failure(ErrorCode::bad_data, path_.string() + ": " + reason(errno));
    if (more == 0) break;
    got += static_cast<std::size_t>(more);
  }
  return got;
}

Result<std::string> InputFile::read(std::size_t from, std::size_t count) const {
  std::string bytes(from >= size() ? 0 : std::min(count, size() - from), '\0');
  const auto got = read(from, bytes.data(), bytes.size());
  if (!got) return tl::unexpected(got.error());
  bytes.resize(*got);
  return bytes;
}

Result<void> InputFile::check_unchanged() const {
  struct stat now {};
  const bool same = ::fstat(file_, &now) == 0 && now.st_size == status_.st_size &&
                    now.st_mtim.tv_sec == status_.st_mtim.tv_sec &&
                    now.st_mtim.tv_nsec == status_.st_mtim.tv_nsec;
  if (same) return {};
  return failure(ErrorCode::bad_data, path_.string() + " changed while it was read",
                 "wait until the bench has written it, or copy it first");
}

}  // namespace flexspline::data
