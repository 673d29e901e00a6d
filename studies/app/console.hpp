#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

namespace flexspline::app {

/// How far a command is.
struct Reached {
  double share = 0.0;  ///< of the work, in [0, 1]; 0: not known
  std::string stage;   ///< what comes now
};

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
  void end_live();
  /// The same, but not while the command has shown a line of its own in the last seconds.
  void live_unless_busy(std::string_view text);
  /// How far the command is, for the line that main shows of a long one.
  void progress(double share, std::string_view stage);
  Reached reached() const;
  /// auto: on a terminal, unless NO_COLOR is set; always; never.
  void colour_messages(std::string_view when);
  bool is_terminal() const { return terminal_; }
  /// Whether a result could not be printed.
  bool result_lost() const { return !result_lost_.empty(); }

 private:
  void clear_live();  ///< with the lock held, as the next
  void show_live(std::string_view text);
  void line(std::string_view text);

  bool terminal_;
  bool colour_;
  bool live_shown_ = false;
  Reached reached_;
  std::chrono::steady_clock::time_point live_at_{};  ///< when the command last showed a line
  mutable std::mutex mutex_;  ///< of the streams: a progress line has a thread of its own
  std::string result_lost_;   ///< why
};

/// Takes the places of a closed stdin, stdout or stderr, so that no file that is opened later gets
/// them and what is said goes into it.
void keep_standard_files_apart();

}  // namespace flexspline::app
