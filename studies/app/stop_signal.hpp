#pragma once

#include <atomic>

namespace flexspline::app {

/// From now on the first SIGINT or SIGTERM asks for a stop, and a second one ends the program at
/// once with exit code 75.
void catch_stop_signals();

/// Becomes true when a stop was asked for.
const std::atomic<bool>& stop_requested();

}  // namespace flexspline::app
