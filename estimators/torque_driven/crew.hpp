#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace flexspline::estimators {

/// Threads that wait for pieces of work: awake for some tens of microseconds, because being woken
/// takes longer than the pause between two evaluations; then asleep, because a thread that spins on
/// a busy machine holds up those that it waits for. The caller works too.
class Crew {
 public:
  explicit Crew(int threads);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  std::size_t size() const { return threads_.size() + 1; }
  /// work(0), ..., work(pieces - 1), each once, in no order; returns when all are done. The work
  /// throws nothing.
  void run(std::size_t pieces, const std::function<void(std::size_t)>& work);

 private:
  void take_pieces(std::unique_lock<std::mutex>& lock);
  void wait_for_work();

  std::mutex mutex_;
  std::condition_variable wake_;
  std::condition_variable finished_;
  const std::function<void(std::size_t)>* work_ = nullptr;
  std::size_t pieces_ = 0;
  std::size_t next_ = 0;
  // Changed under the mutex, watched without it.
  std::atomic<std::size_t> undone_ = 0;
  std::atomic<std::size_t> rounds_ = 0;
  std::atomic<bool> leave_ = false;
  std::vector<std::jthread> threads_;
};

/// The processors that a fit may use beside the others that run now: cases in parallel come before
/// recordings in parallel. Counts the fit as running as long as it lives.
class ProcessorShare {
 public:
  /// wanted: 0 for the share, else that many.
  explicit ProcessorShare(int wanted);
  ~ProcessorShare();
  ProcessorShare(const ProcessorShare&) = delete;
  ProcessorShare& operator=(const ProcessorShare&) = delete;

  int threads() const { return threads_; }

 private:
  int threads_;
};

}  // namespace flexspline::estimators
