#pragma once

#include <string>
#include <string_view>

namespace flexspline::app {

/// Where a command speaks: results to stdout, everything else to stderr. It never throws: what
/// cannot be said (a closed or full stderr) is dropped, and of a result it is known.
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
  /// Whether a result could not be printed.
  bool result_lost() const { return !result_lost_.empty(); }

 private:
  void clear_live();
  void line(std::string_view text);

  bool terminal_;
  bool colour_;
  bool live_shown_ = false;
  std::string result_lost_;  ///< why
};

/// Takes the places of a closed stdin, stdout or stderr, so that no file that is opened later gets
/// them and what is said goes into it.
void keep_standard_files_apart();

}  // namespace flexspline::app
