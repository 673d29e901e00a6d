#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "engines/pull_packs.hpp"
#include "flexspline/core/case_store.hpp"
#include "flexspline/studies/engine.hpp"

namespace flexspline::studies {

using EngineClock = std::chrono::steady_clock;

/// The cases that are left to do, and what became of them. Any thread may ask.
class CaseQueue {
 public:
  CaseQueue(CaseSource& source, const EngineSettings& settings, std::size_t workers);

  /// What the folder holds counts as done. who: this run among others in the folder.
  /// Errors: those of CaseStore::open, cannot_write.
  Result<void> plan(const std::string& who);

  /// The next case of a worker; none() where there is none, or a stop was asked for; later() where
  /// there may be one soon.
  std::size_t pull(std::size_t worker);
  /// Computes it. Never throws. Errors: nothing can be computed any more.
  Result<StoredCase> compute(std::size_t number);
  StoredCase give_up(std::size_t number, const Error& why);
  /// Counts a case that was written.
  void count(std::size_t worker, const StoredCase& one);
  void break_off(const Error& error);

  CaseName name(std::size_t number) const { return source_->name(number); }
  std::size_t none() const { return source_->size(); }
  std::size_t later() const { return source_->size() + 1; }
  std::size_t left() const { return puller_ ? source_->size() : todo_.size(); }
  Progress progress() const;
  Result<EngineSummary> summary() const;

 private:
  struct Worker {
    std::atomic<std::size_t> number{0};
    std::atomic<EngineClock::rep> since{0};  ///< 0: idle
  };

  Result<void> set_stale_aside(const CaseStore& store,
                               const std::vector<CaseStore::Digest>& planned);
  Result<std::vector<bool>> done_in_folder() const;
  Result<void> plan_pulling(const std::string& who);
  /// Takes the next pack; whether there may be one later.
  bool take_pack();
  void note_failure(std::string_view key, std::string_view reason);

  CaseSource* source_;
  const EngineSettings* settings_;
  std::vector<std::size_t> todo_;
  std::size_t next_ = 0;  ///< of them
  std::mutex pulling_;    ///< of both
  std::optional<PackPuller> puller_;
  bool stopped_ = false;  ///< before all of it was taken
  std::atomic<std::size_t> computed_{0};
  std::atomic<std::size_t> failed_{0};
  std::atomic<bool> broken_{false};
  std::unique_ptr<Worker[]> workers_;
  std::size_t worker_count_;
  EngineClock::time_point start_ = EngineClock::now();
  mutable std::mutex mutex_;
  std::optional<Error> error_;
  EngineSummary summary_;
};

/// Workers are threads of this process.
void run_in_threads(CaseQueue& queue, const EngineSettings& settings, std::size_t workers);

/// Workers are processes, held to the limits. To be called before any other thread works.
void run_in_processes(CaseQueue& queue, const EngineSettings& settings, std::size_t workers);

}  // namespace flexspline::studies
