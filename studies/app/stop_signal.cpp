#include "stop_signal.hpp"

#include <csignal>

#include <unistd.h>

#include "flexspline/core/error.hpp"

namespace flexspline::app {
namespace {

std::atomic<bool> requested = false;
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

void on_signal(int) {
  if (requested.exchange(true)) _exit(static_cast<int>(ErrorCode::interrupted));
}

}  // namespace

void catch_stop_signals() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

const std::atomic<bool>& stop_requested() { return requested; }

}  // namespace flexspline::app
