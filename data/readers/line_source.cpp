#include "readers/line_source.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace flexspline::data {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 18U;

tl::unexpected<Error> not_read(const std::filesystem::path& path, const std::string& why) {
  return failure(ErrorCode::input_missing, "cannot read " + path.string() + ": " + why,
                 "check the path and its permissions");
}

std::int64_t time_of_change(const struct stat& status) {
  return std::int64_t{1'000'000'000} * status.st_mtim.tv_sec + status.st_mtim.tv_nsec;
}

std::string reason(int code) { return std::generic_category().message(code); }

}  // namespace

Result<LineSource> LineSource::open(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return not_read(path, reason(errno));
  struct stat status {};
  const int code = ::fstat(file, &status) == 0 ? 0 : errno;
  LineSource source(file, code == 0 ? static_cast<std::size_t>(status.st_size) : 0,
                    time_of_change(status));
  if (code != 0) return not_read(path, reason(code));
  if (!S_ISREG(status.st_mode)) return not_read(path, "it is no regular file");
  return source;
}

LineSource::LineSource(LineSource&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      file_bytes_(other.file_bytes_),
      changed_ns_(other.changed_ns_),
      buffer_(std::move(other.buffer_)),
      begin_(other.begin_),
      end_(other.end_),
      cut_(other.cut_),
      problem_(std::move(other.problem_)) {}

LineSource::~LineSource() {
  if (file_ >= 0) ::close(file_);
}

std::optional<std::string_view> LineSource::next() {
  std::size_t searched = begin_;
  while (true) {
    const void* found =
        end_ > searched ? std::memchr(buffer_.data() + searched, '\n', end_ - searched) : nullptr;
    if (found != nullptr) {
      const auto stop = static_cast<std::size_t>(static_cast<const char*>(found) - buffer_.data());
      const std::size_t from = std::exchange(begin_, stop + 1);
      return std::string_view(buffer_).substr(from, stop - from);
    }
    if (end_ - begin_ > kLongestLine) {
      cut_ = true;
      return std::string_view(buffer_).substr(begin_, kLongestLine);
    }
    const std::size_t pending = end_ - begin_;
    if (!read_more()) break;
    searched = begin_ + pending;
  }
  if (!problem_.empty() || begin_ == end_) return std::nullopt;
  const std::size_t from = std::exchange(begin_, end_);
  return std::string_view(buffer_).substr(from, end_ - from);
}

bool LineSource::has_changed() const {
  struct stat now {};
  if (::fstat(file_, &now) != 0) return true;
  return static_cast<std::size_t>(now.st_size) != file_bytes_ || time_of_change(now) != changed_ns_;
}

bool LineSource::read_more() {
  if (begin_ > 0) std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= std::exchange(begin_, 0);
  if (buffer_.size() < end_ + kBlock) buffer_.resize(end_ + kBlock);
  ssize_t got = 0;
  do {
    got = ::read(file_, buffer_.data() + end_, kBlock);
  } while (got < 0 && errno == EINTR);
  if (got < 0) problem_ = reason(errno);
  if (got == 0 && has_changed()) problem_ = "it changed while it was read";
  if (got > 0) end_ += static_cast<std::size_t>(got);
  return got > 0;
}

}  // namespace flexspline::data
