#pragma once

#include <atomic>

namespace flexspline::app {

/// From now on the first SIGINT or SIGTERM asks for a stop. A command that looks may end by itself
/// within a second; otherwise the program is ended for it, between two writes, so that every file
/// there is is whole. A second signal ends it at once. Exit code 75 either way. Once a process.
void catch_stop_signals();

/// Becomes true when a stop was asked for.
const std::atomic<bool>& stop_requested();

}  // namespace flexspline::app
