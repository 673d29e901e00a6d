#include "flexspline/core/in_parallel.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace flexspline {
namespace {

// Looks for a while whether something has come about; sleeping is up to the caller. Being woken
// takes longer than the pause between two rounds of work; but who spins for long on a busy machine
// holds up those that it waits for. It does not yield: there that gives away milliseconds.
template <class Condition>
void watch_for(const Condition& come_about) {
  constexpr std::chrono::microseconds kPatience(60);
  const auto until = std::chrono::steady_clock::now() + kPatience;
  while (!come_about() && std::chrono::steady_clock::now() < until) {
  }
}

// Asked once: the system reads a file for it.
std::size_t processors() {
  static const std::size_t count = std::max(1U, std::thread::hardware_concurrency());
  return count;
}

// One call's jobs. But for `undone`, which its caller watches, under the helpers' mutex.
struct Batch {
  const std::function<void(std::size_t)>& job;
  std::size_t count;
  std::size_t helpers_wanted;
  std::size_t next = 0;
  std::atomic<std::size_t> undone = count;
  std::condition_variable finished{};
  std::exception_ptr thrown{};

  bool open() const { return next < count; }
};

/// The threads of the process that help those who have many jobs: started when first wanted, asleep
/// between batches, ended with the process.
class Helpers {
 public:
  void run(Batch& batch);

 private:
  void start(std::size_t wanted);
  void help();
  Batch* open_batch();
  void work_on(Batch& batch, std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable wake_;
  std::atomic<std::size_t> batches_seen_ = 0;
  std::vector<Batch*> batches_;
  std::size_t started_ = 0;
  std::size_t idle_ = 0;
};

// The caller works on its own batch only, and waits only for jobs that run: batches within jobs
// cannot block one another.
void Helpers::run(Batch& batch) {
  std::unique_lock lock(mutex_);
  start(batch.helpers_wanted);
  batches_.push_back(&batch);
  ++batches_seen_;
  wake_.notify_all();
  work_on(batch, lock);
  std::erase(batches_, &batch);
  lock.unlock();
  watch_for([&] { return batch.undone == 0; });
  lock.lock();
  batch.finished.wait(lock, [&] { return batch.undone == 0; });
}

// As many as are wanted beside those that are at work, within bounds.
void Helpers::start(std::size_t wanted) {
  const std::size_t most = std::max(wanted, 2 * processors());
  while (idle_ < wanted && started_ < most) {
    std::thread([this] { help(); }).detach();
    ++started_;
    ++idle_;
  }
}

Batch* Helpers::open_batch() {
  const auto found = std::ranges::find_if(
      batches_, [](const Batch* batch) { return batch->open() && batch->helpers_wanted > 0; });
  return found == batches_.end() ? nullptr : *found;
}

void Helpers::help() {
  std::unique_lock lock(mutex_);
  while (true) {
    const std::size_t seen = batches_seen_;
    while (Batch* const batch = open_batch()) {
      --batch->helpers_wanted;
      --idle_;
      work_on(*batch, lock);
      ++idle_;
    }
    lock.unlock();
    watch_for([&] { return batches_seen_ != seen; });
    lock.lock();
    wake_.wait(lock, [this] { return open_batch() != nullptr; });
  }
}

void Helpers::work_on(Batch& batch, std::unique_lock<std::mutex>& lock) {
  while (batch.open()) {
    const std::size_t one = batch.next++;
    std::exception_ptr thrown;
    lock.unlock();
    try {
      batch.job(one);
    } catch (...) {
      thrown = std::current_exception();
    }
    lock.lock();
    if (thrown && !batch.thrown) {
      batch.thrown = thrown;
      batch.undone -= batch.count - batch.next;
      batch.next = batch.count;
    }
    if (--batch.undone == 0) batch.finished.notify_one();
  }
}

// Never destroyed: its threads sleep on it until the process is gone.
Helpers& helpers() {
  static Helpers& all = *new Helpers;
  return all;
}

}  // namespace

std::size_t threads_for(std::size_t wanted) { return wanted > 0 ? wanted : processors(); }

void in_parallel(std::size_t count, std::size_t threads,
                 const std::function<void(std::size_t)>& job) {
  const std::size_t all = std::min(threads_for(threads), count);
  if (all < 2) {
    for (std::size_t i = 0; i < count; ++i) job(i);
    return;
  }
  Batch batch{.job = job, .count = count, .helpers_wanted = all - 1};
  helpers().run(batch);
  if (batch.thrown) std::rethrow_exception(batch.thrown);
}

}  // namespace flexspline
