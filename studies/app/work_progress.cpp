#include "work_progress.hpp"

#include <fmt/format.h>

namespace flexspline::app {
namespace {

constexpr std::chrono::seconds kPatience(2);
constexpr std::chrono::seconds kRenewal(1);
constexpr double kTelling = 0.02;  // share from which the rest can be estimated

}  // namespace

WorkProgress::WorkProgress(Console& console, std::string what)
    : console_(console), what_(std::move(what)) {
  if (console.is_terminal() && !console.quiet) watcher_ = std::thread([this] { watch(); });
}

WorkProgress::~WorkProgress() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
  if (!watcher_.joinable()) return;
  watcher_.join();
  console_.end_live();
}

void WorkProgress::watch() {
  const auto started = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  auto wait = kPatience;
  while (!changed_.wait_for(lock, wait, [this] { return over_; })) {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - started;
    console_.live_unless_busy(progress_text(what_, console_.reached(), passed.count()));
    wait = kRenewal;
  }
}

std::string progress_text(const std::string& what, const Reached& reached, double seconds) {
  std::string line = what;
  if (reached.share >= kTelling) {
    line += fmt::format(", {:.0f} %, {:.0f} s left", 100.0 * reached.share,
                        seconds * (1.0 - reached.share) / reached.share);
  } else {
    line += fmt::format(", {:.0f} s", seconds);
  }
  return reached.stage.empty() ? line : line + ": " + reached.stage;
}

}  // namespace flexspline::app
