#pragma once

#include <string>
#include <string_view>

namespace flexspline::app {

/// Where a command speaks: results to stdout, everything else to stderr.
class Console {
 public:
  bool json = false;   ///< results as JSON
  bool quiet = false;  ///< errors only on stderr
  int verbosity = 0;

  Console();

  /// A result, to stdout, with a line end.
  void result(std::string_view text);
  /// News on stderr; not when quiet.
  void say(std::string_view text);
  /// Details on stderr; only with -v.
  void detail(std::string_view text);
  /// What went wrong, on stderr.
  void error(std::string_view text);
  /// A line that the next one overwrites: on a terminal only, else nothing.
  void live(std::string_view text);
  bool is_terminal() const { return terminal_; }

 private:
  void line(std::string_view text);

  bool terminal_;
  bool colour_;
  bool live_shown_ = false;
};

}  // namespace flexspline::app
