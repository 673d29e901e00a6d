#include "torque_driven/crew.hpp"

#include <algorithm>
#include <chrono>

#include "flexspline/core/in_parallel.hpp"

namespace flexspline::estimators {
namespace {

// Looks for a while whether something has come about; sleeping is up to the caller. It does not
// yield: on a busy machine that gives away milliseconds.
template <class Condition>
void watch_for(const Condition& come_about) {
  constexpr std::chrono::microseconds kPatience(60);
  const auto until = std::chrono::steady_clock::now() + kPatience;
  while (!come_about() && std::chrono::steady_clock::now() < until) {
  }
}

std::atomic<int>& running_fits() {
  static std::atomic<int> count = 0;
  return count;
}

}  // namespace

Crew::Crew(int threads) {
  for (int k = 1; k < threads; ++k) threads_.emplace_back([this] { wait_for_work(); });
}

Crew::~Crew() {
  {
    const std::lock_guard lock(mutex_);
    leave_ = true;
  }
  wake_.notify_all();
}

void Crew::run(std::size_t pieces, const std::function<void(std::size_t)>& work) {
  if (threads_.empty() || pieces < 2) {
    for (std::size_t k = 0; k < pieces; ++k) work(k);
    return;
  }
  std::unique_lock lock(mutex_);
  work_ = &work;
  pieces_ = undone_ = pieces;
  next_ = 0;
  ++rounds_;
  wake_.notify_all();
  take_pieces(lock);
  lock.unlock();
  watch_for([this] { return undone_ == 0; });
  lock.lock();
  finished_.wait(lock, [this] { return undone_ == 0; });
}

void Crew::take_pieces(std::unique_lock<std::mutex>& lock) {
  while (next_ < pieces_) {
    const std::size_t piece = next_++;
    const auto* work = work_;
    lock.unlock();
    (*work)(piece);
    lock.lock();
    if (--undone_ == 0) finished_.notify_one();
  }
}

void Crew::wait_for_work() {
  std::unique_lock lock(mutex_);
  while (!leave_) {
    const std::size_t seen = rounds_;
    lock.unlock();
    watch_for([&] { return leave_ || rounds_ != seen; });
    lock.lock();
    wake_.wait(lock, [this] { return leave_ || next_ < pieces_; });
    take_pieces(lock);
  }
}

ProcessorShare::ProcessorShare(int wanted) {
  const int running = ++running_fits();
  threads_ = wanted > 0 ? wanted : std::max(1, static_cast<int>(threads_for(0)) / running);
}

ProcessorShare::~ProcessorShare() { --running_fits(); }

}  // namespace flexspline::estimators
