#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "console.hpp"

namespace flexspline::app {

/// A line on a terminal for a command that takes longer than two seconds, renewed every second: how
/// long it has run or, where it has told the console how far it is, how long it takes still. It
/// keeps silent while the command shows lines of its own.
class WorkProgress {
 public:
  WorkProgress(Console& console, std::string what);
  WorkProgress(const WorkProgress&) = delete;
  WorkProgress& operator=(const WorkProgress&) = delete;
  ~WorkProgress();

 private:
  void watch();

  Console& console_;
  std::string what_;
  bool over_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::thread watcher_;
};

/// "diagnose, 45 %, 12 s left: fitting" after so many seconds.
std::string progress_text(const std::string& what, const Reached& reached, double seconds);

}  // namespace flexspline::app
