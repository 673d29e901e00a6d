#include "console.hpp"

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <fmt/format.h>

namespace flexspline::app {
namespace {

/// 0, or the errno of the write that failed.
int put(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written >= 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno == EAGAIN) {
      pollfd ready{file, POLLOUT, 0};
      ::poll(&ready, 1, -1);
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

}  // namespace

Console::Console()
    : terminal_(isatty(STDERR_FILENO) != 0),
      colour_(terminal_ && std::getenv("NO_COLOR") == nullptr) {}

void Console::clear_live() {
  if (live_shown_) static_cast<void>(put(STDERR_FILENO, "\r\x1b[K"));
  live_shown_ = false;
}

void Console::end_live() {
  const std::lock_guard lock(mutex_);
  clear_live();
}

void Console::colour_messages(std::string_view when) {
  if (when != "auto") colour_ = when == "always";
}

void Console::line(std::string_view text) {
  const std::lock_guard lock(mutex_);
  clear_live();
  static_cast<void>(put(STDERR_FILENO, fmt::format("{}\n", text)));
}

void Console::result(std::string_view text) {
  end_live();
  const int failed = put(STDOUT_FILENO, fmt::format("{}\n", text));
  if (failed == 0 || !result_lost_.empty()) return;
  result_lost_ = std::generic_category().message(failed);
  if (failed == EPIPE) return;  // who closed the pipe wants no more
  error(fmt::format("the result cannot be printed: {}; what was computed is kept", result_lost_));
}

void Console::say(std::string_view text) {
  if (!quiet) line(text);
}

void Console::detail(std::string_view text) {
  if (!quiet && verbosity > 0) line(text);
}

void Console::error(std::string_view text) {
  line(colour_ ? fmt::format("\x1b[31mflexspline:\x1b[0m {}", text)
               : fmt::format("flexspline: {}", text));
}

void Console::live(std::string_view text) {
  if (quiet || !terminal_) return;
  const std::lock_guard lock(mutex_);
  live_at_ = std::chrono::steady_clock::now();
  show_live(text);
}

void Console::live_unless_busy(std::string_view text) {
  constexpr std::chrono::seconds kBusy(10);
  const std::lock_guard lock(mutex_);
  if (std::chrono::steady_clock::now() - live_at_ > kBusy) show_live(text);
}

void Console::show_live(std::string_view text) {
  static_cast<void>(put(STDERR_FILENO, fmt::format("\r\x1b[K{}", text)));
  live_shown_ = true;
}

void Console::progress(double share, std::string_view stage) {
  const std::lock_guard lock(mutex_);
  reached_ = {share, std::string(stage)};
}

Reached Console::reached() const {
  const std::lock_guard lock(mutex_);
  return reached_;
}

void keep_standard_files_apart() {
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(file, F_GETFD) >= 0) continue;
    // For reading only: writing to it still fails.
    if (::open("/dev/null", O_RDONLY) != file) return;
  }
}

}  // namespace flexspline::app
