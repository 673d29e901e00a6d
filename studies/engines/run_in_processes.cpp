#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <optional>
#include <thread>

#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "engines/case_queue.hpp"

namespace flexspline::studies {
namespace {

constexpr int kTickMs = 200;

bool get(int file, void* to, std::size_t size) {
  auto* at = static_cast<char*>(to);
  while (size > 0) {
    const ssize_t got = ::read(file, at, size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

bool put(int file, const void* from, std::size_t size) {
  const auto* at = static_cast<const char*>(from);
  while (size > 0) {
    const ssize_t written = ::write(file, at, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    at += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

bool put_text(int file, const std::string& text) {
  const std::uint64_t size = text.size();
  return put(file, &size, sizeof size) && put(file, text.data(), text.size());
}

bool get_text(int file, std::string& text) {
  std::uint64_t size = 0;
  if (!get(file, &size, sizeof size)) return false;
  text.resize(size);
  return get(file, text.data(), size);
}

/// Bytes of address space that the process has now.
rlim_t address_space() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

void hold_to(const CaseLimits& limits) {
  if (!(limits.memory_mb > 0.0)) return;
  const rlim_t most = address_space() + static_cast<rlim_t>(limits.memory_mb * 1e6);
  const rlimit limit{most, most};
  ::setrlimit(RLIMIT_AS, &limit);
}

/// A worker's life: numbers come, answers go. The first word of an answer says whether the journal
/// could be written.
[[noreturn]] void serve(CaseQueue& queue, const EngineSettings& settings, int in, int out) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  hold_to(settings.limits);
  auto journal = JournalWriter::open(settings.folder / "journals");
  std::uint64_t number = 0;
  while (get(in, &number, sizeof number)) {
    const auto one = journal ? queue.compute(number) : tl::unexpected(journal.error());
    const auto written =
        one ? append_case(*journal, *one) : Result<void>(tl::unexpected(one.error()));
    const std::string problem = written ? "" : written.error().message();
    if (!put_text(out, problem) || !put_text(out, one ? one->failure : "")) break;
  }
  ::_exit(0);
}

/// A worker as its master sees it.
class WorkerProcess {
 public:
  WorkerProcess(CaseQueue& queue, const EngineSettings& settings, std::size_t worker)
      : queue_(&queue), settings_(&settings), worker_(worker) {}
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;
  ~WorkerProcess() { end(SIGKILL); }

  bool busy() const { return busy_; }
  bool waits() const { return waits_; }  ///< for a case that may come
  int answers() const { return from_; }

  /// Hands out the next case; false where there is none.
  bool begin() {
    number_ = queue_->pull(worker_);
    waits_ = number_ == queue_->later();
    if (waits_ || number_ == queue_->none()) return false;
    if (child_ <= 0 && !start()) return false;
    const std::uint64_t number = number_;
    static_cast<void>(put(to_, &number, sizeof number));  // where it is gone, its answer says so
    begun_ = EngineClock::now();
    busy_ = true;
    return true;
  }

  void take_answer() {
    std::string problem;
    StoredCase one;
    one.key = queue_->name(number_).key;
    if (!get_text(from_, problem) || !get_text(from_, one.failure)) {
      give_up(fmt::format("it ended its process ({})", cause_of_death()));
      return;
    }
    busy_ = false;
    if (problem.empty()) return queue_->count(worker_, one);
    queue_->break_off({ErrorCode::cannot_write, problem, {}, {}});
  }

  void check_time() {
    const double limit = settings_->limits.seconds;
    const double spent = std::chrono::duration<double>(EngineClock::now() - begun_).count();
    if (busy_ && limit > 0.0 && spent > limit) {
      give_up(fmt::format("it took longer than {:g} s, the limit of a case", limit));
    }
  }

 private:
  bool start() {
    std::array<int, 2> down{};
    std::array<int, 2> up{};
    if (::pipe(down.data()) != 0 || ::pipe(up.data()) != 0) return fail_to_start();
    child_ = ::fork();
    if (child_ < 0) return fail_to_start();
    if (child_ == 0) {
      ::close(down[1]);
      ::close(up[0]);
      serve(*queue_, *settings_, down[0], up[1]);
    }
    ::close(down[0]);
    ::close(up[1]);
    to_ = down[1];
    from_ = up[0];
    return true;
  }

  bool fail_to_start() {
    queue_->break_off({ErrorCode::cannot_write,
                       fmt::format("no worker can be started: {}", std::strerror(errno)),
                       "allow this user more processes, or take fewer --jobs",
                       {}});
    return false;
  }

  std::string cause_of_death() {
    const int status = end(0);
    if (WIFSIGNALED(status)) return fmt::format("signal {}", WTERMSIG(status));
    return fmt::format("exit status {}", WEXITSTATUS(status));
  }

  /// The journal's record, by the master, for a worker that cannot write it any more.
  void give_up(const std::string& why) {
    end(SIGKILL);
    busy_ = false;
    const StoredCase one = queue_->give_up(
        number_, {ErrorCode::numerics, why, "raise the limit, or leave the case out", {}});
    auto journal = JournalWriter::open(settings_->folder / "journals");
    const auto written =
        journal ? append_case(*journal, one) : Result<void>(tl::unexpected(journal.error()));
    if (!written) return queue_->break_off(written.error());
    queue_->count(worker_, one);
  }

  int end(int signal) {
    if (child_ <= 0) return 0;
    if (signal != 0) ::kill(child_, signal);
    ::close(to_);
    ::close(from_);
    int status = 0;
    while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    child_ = 0;
    return status;
  }

  CaseQueue* queue_;
  const EngineSettings* settings_;
  std::size_t worker_;
  pid_t child_ = 0;
  int to_ = -1;
  int from_ = -1;
  std::size_t number_ = 0;
  bool busy_ = false;
  bool waits_ = false;
  EngineClock::time_point begun_;
};

}  // namespace

void run_in_processes(CaseQueue& queue, const EngineSettings& settings, std::size_t workers) {
  std::vector<std::unique_ptr<WorkerProcess>> all;
  for (std::size_t w = 0; w < workers; ++w) {
    all.push_back(std::make_unique<WorkerProcess>(queue, settings, w));
    all.back()->begin();
  }
  EngineClock::time_point next;
  while (true) {
    std::vector<pollfd> waiting;
    std::vector<WorkerProcess*> whose;
    bool any_waits = false;
    for (const auto& one : all) {
      if (one->waits()) one->begin();
      any_waits = any_waits || one->waits();
      if (!one->busy()) continue;
      waiting.push_back({one->answers(), POLLIN, 0});
      whose.push_back(one.get());
    }
    if (waiting.empty() && !any_waits) return;
    ::poll(waiting.data(), waiting.size(), kTickMs);
    for (std::size_t i = 0; i < whose.size(); ++i) {
      if (waiting[i].revents != 0)
        whose[i]->take_answer();
      else
        whose[i]->check_time();
      if (!whose[i]->busy()) whose[i]->begin();
    }
    if (EngineClock::now() < next) continue;
    next = EngineClock::now() + std::chrono::milliseconds(kTickMs);
    settings.progress(queue.progress());
  }
}

}  // namespace flexspline::studies
