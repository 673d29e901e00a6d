#pragma once

#include <future>
#include <map>
#include <memory>
#include <mutex>

namespace flexspline::studies {

/// Computes every value once, whoever asks for its key first, and lets it go after the last who
/// announced to ask.
template <class Key, class Value>
class Once {
 public:
  using Shared = std::shared_ptr<const Value>;

  /// Announces a later take.
  void reserve(const Key& key) { ++users_[key]; }

  /// The value; the caller keeps it alive as long as it needs it. compute does not throw.
  template <class Compute>
  Shared take(const Key& key, const Compute& compute) {
    std::promise<Shared> promise;
    std::shared_future<Shared> future;
    bool first = false;
    {
      const std::scoped_lock lock(mutex_);
      auto found = values_.find(key);
      first = found == values_.end();
      if (first) found = values_.emplace(key, promise.get_future().share()).first;
      future = found->second;
      if (--users_[key] <= 0) values_.erase(found);
    }
    if (first) promise.set_value(std::make_shared<const Value>(compute()));
    return future.get();
  }

 private:
  std::mutex mutex_;
  std::map<Key, int> users_;
  std::map<Key, std::shared_future<Shared>> values_;
};

}  // namespace flexspline::studies
