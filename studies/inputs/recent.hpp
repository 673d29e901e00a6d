#pragma once

#include <exception>
#include <future>
#include <list>
#include <map>
#include <memory>
#include <mutex>

namespace flexspline::studies {

/// Computes a value once, whoever asks for its key first, and keeps those that were asked for last.
template <class Key, class Value>
class Recent {
 public:
  using Shared = std::shared_ptr<const Value>;

  explicit Recent(std::size_t most) : most_(most) {}

  /// What compute throws, everybody who asked for the key gets, until it is no longer kept.
  template <class Compute>
  Shared take(const Key& key, const Compute& compute) {
    std::promise<Shared> promise;
    std::shared_future<Shared> future;
    bool first = false;
    {
      const std::scoped_lock lock(mutex_);
      auto found = values_.find(key);
      first = found == values_.end();
      if (first) {
        order_.push_front(key);
        found = values_.emplace(key, Kept{promise.get_future().share(), order_.begin()}).first;
      }
      order_.splice(order_.begin(), order_, found->second.place);
      future = found->second.value;
      if (values_.size() > most_) {
        values_.erase(order_.back());
        order_.pop_back();
      }
    }
    if (first) fulfil(promise, compute);
    return future.get();
  }

 private:
  template <class Compute>
  static void fulfil(std::promise<Shared>& promise, const Compute& compute) {
    try {
      promise.set_value(std::make_shared<const Value>(compute()));
    } catch (...) {
      promise.set_exception(std::current_exception());
    }
  }

  struct Kept {
    std::shared_future<Shared> value;
    typename std::list<Key>::iterator place;
  };

  std::size_t most_;
  std::mutex mutex_;
  std::list<Key> order_;  ///< the last asked for first
  std::map<Key, Kept> values_;
};

}  // namespace flexspline::studies
