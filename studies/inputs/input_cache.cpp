#include "inputs/input_cache.hpp"

namespace flexspline::studies {

InputCache::Prepared InputCache::take(const InputPlan& input) {
  std::promise<Prepared> promise;
  std::shared_future<Prepared> future;
  bool first = false;
  {
    const std::scoped_lock lock(mutex_);
    auto found = prepared_.find(&input);
    first = found == prepared_.end();
    if (first) found = prepared_.emplace(&input, promise.get_future().share()).first;
    future = found->second;
    if (--users_[&input] <= 0) prepared_.erase(found);
  }
  if (first) {
    promise.set_value(std::make_shared<const Result<PreparedInput>>(prepare_input(*plan_, input)));
  }
  return future.get();
}

}  // namespace flexspline::studies
