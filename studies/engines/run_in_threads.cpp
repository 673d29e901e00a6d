#include <condition_variable>
#include <thread>

#include "engines/case_queue.hpp"

namespace flexspline::studies {
namespace {

using namespace std::chrono_literals;

constexpr auto kTick = 200ms;

/// Tells how far it is until it goes out of scope.
class Ticker {
 public:
  Ticker(const CaseQueue& queue, const EngineSettings& settings)
      : thread_([this, &queue, &settings] {
          std::unique_lock lock(mutex_);
          while (!over_.wait_for(lock, kTick, [&] { return ended_; })) {
            settings.progress(queue.progress());
          }
        }) {}
  ~Ticker() {
    {
      const std::scoped_lock lock(mutex_);
      ended_ = true;
    }
    over_.notify_all();
    thread_.join();
  }
  Ticker(const Ticker&) = delete;
  Ticker& operator=(const Ticker&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable over_;
  bool ended_ = false;
  std::thread thread_;
};

void work(CaseQueue& queue, const EngineSettings& settings, std::size_t worker) {
  const auto pull = [&] {
    std::size_t number = queue.pull(worker);
    for (; number == queue.later(); number = queue.pull(worker)) std::this_thread::sleep_for(kTick);
    return number;
  };
  std::size_t number = pull();
  if (number == queue.none()) return;
  auto journal = JournalWriter::open(settings.folder / "journals");
  if (!journal) return queue.break_off(journal.error());
  for (; number != queue.none(); number = pull()) {
    const auto one = queue.compute(number);
    if (!one) return queue.break_off(one.error());
    if (const auto written = append_case(*journal, *one); !written) {
      return queue.break_off(written.error());
    }
    queue.count(worker, *one);
  }
}

}  // namespace

void run_in_threads(CaseQueue& queue, const EngineSettings& settings, std::size_t workers) {
  const Ticker ticker(queue, settings);
  std::vector<std::jthread> threads;
  for (std::size_t worker = 1; worker < workers; ++worker) {
    threads.emplace_back([&queue, &settings, worker] { work(queue, settings, worker); });
  }
  work(queue, settings, 0);
}

}  // namespace flexspline::studies
