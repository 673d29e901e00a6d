#include "stop_signal.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <thread>

#include <semaphore.h>
#include <unistd.h>

#include "console.hpp"
#include "flexspline/core/error.hpp"
#include "flexspline/core/write_file.hpp"

namespace flexspline::app {
namespace {

using namespace std::chrono_literals;

constexpr auto kGrace = 800ms;     // in which a command may end by itself
constexpr auto kPatience = 500ms;  // for files that are being written

constexpr int kInterrupted = static_cast<int>(ErrorCode::interrupted);

std::atomic<bool> requested = false;
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");
sem_t asked;

void on_signal(int) {
  if (requested.exchange(true)) {
    remove_unfinished_files();
    _exit(kInterrupted);
  }
  sem_post(&asked);
}

/// Whatever loop of whichever library the program is in: what is finished lies on disk, every file
/// whole, and the work at hand is dropped.
void end_when_asked() {
  while (sem_wait(&asked) != 0 && errno == EINTR) {
  }
  std::this_thread::sleep_for(kGrace);
  let_no_write_begin(kPatience);
  Console().error("interrupted; the same command goes on from what is finished, or begins anew");
  _exit(kInterrupted);
}

}  // namespace

void catch_stop_signals() {
  sem_init(&asked, 0, 0);
  std::thread(end_when_asked).detach();
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

const std::atomic<bool>& stop_requested() { return requested; }

}  // namespace flexspline::app
