#include "console.hpp"

#include <cstdio>
#include <cstdlib>

#include <unistd.h>

#include <fmt/format.h>

namespace flexspline::app {

Console::Console()
    : terminal_(isatty(STDERR_FILENO) != 0),
      colour_(terminal_ && std::getenv("NO_COLOR") == nullptr) {}

void Console::line(std::string_view text) {
  if (live_shown_) fmt::print(stderr, "\r\x1b[K");
  live_shown_ = false;
  fmt::print(stderr, "{}\n", text);
}

void Console::result(std::string_view text) {
  if (live_shown_) fmt::print(stderr, "\r\x1b[K");
  live_shown_ = false;
  fmt::print("{}\n", text);
  std::fflush(stdout);
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
  fmt::print(stderr, "\r\x1b[K{}", text);
  std::fflush(stderr);
  live_shown_ = true;
}

}  // namespace flexspline::app
