#pragma once

#include <future>
#include <map>
#include <memory>
#include <mutex>

#include "inputs/prepared_input.hpp"

namespace flexspline::studies {

/// Prepares every input once, whoever asks first, and lets it go after its last user.
class InputCache {
 public:
  explicit InputCache(const StudyPlan& plan) : plan_(&plan) {}

  using Prepared = std::shared_ptr<const Result<PreparedInput>>;

  /// Announces a later take.
  void reserve(const InputPlan& input) { ++users_[&input]; }
  /// The input; the caller keeps it alive as long as it needs it.
  Prepared take(const InputPlan& input);

 private:
  const StudyPlan* plan_;
  std::mutex mutex_;
  std::map<const InputPlan*, int> users_;
  std::map<const InputPlan*, std::shared_future<Prepared>> prepared_;
};

}  // namespace flexspline::studies
