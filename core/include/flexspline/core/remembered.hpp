#pragma once

#include <cstdint>
#include <deque>
#include <exception>
#include <future>
#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

#include "flexspline/core/recording.hpp"

namespace flexspline {

/// What a value depends on, as numbers. Bit for bit: a NaN equals itself.
struct Content {
  std::vector<double> numbers;

  /// Adds a series, and where it ends.
  void add(std::span<const double> series);
  bool same_as(const Content& other) const;
  std::uint64_t hash() const;
  std::size_t bytes() const;
};

/// What the smoothing of a record depends on: not its name nor what it is used for.
Content content_of(const TorsionRecord& record);

/// Computes a value once, whoever asks first, for all that depend on the same content; the oldest
/// are forgotten when the contents together are larger than `most_bytes`.
template <class Value>
class Remembered {
 public:
  explicit Remembered(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  template <class Compute>
  std::shared_ptr<const Value> of(Content content, const Compute& compute) {
    std::promise<std::shared_ptr<const Value>> promise;
    const auto [entry, mine] = find(std::move(content), promise);
    if (!entry) return std::make_shared<const Value>(compute());
    if (mine) keep(promise, compute);
    return entry->value.get();
  }

 private:
  struct Entry {
    Content content;
    std::shared_future<std::shared_ptr<const Value>> value;
  };
  using Promise = std::promise<std::shared_ptr<const Value>>;

  template <class Compute>
  static void keep(Promise& promise, const Compute& compute) {
    try {
      promise.set_value(std::make_shared<const Value>(compute()));
    } catch (...) {
      promise.set_exception(std::current_exception());  // whoever waits must not wait for ever
    }
  }

  /// The entry of this content, and whether the caller has to keep its promise. None where another
  /// content has the same hash, or one is larger than everything that is remembered.
  std::pair<std::shared_ptr<const Entry>, bool> find(Content content, Promise& promise) {
    const std::uint64_t hash = content.hash();
    const std::scoped_lock lock(mutex_);
    const auto found = entries_.find(hash);
    if (found != entries_.end()) {
      return {found->second->content.same_as(content) ? found->second : nullptr, false};
    }
    const std::size_t bytes = content.bytes();
    if (bytes > most_bytes_) return {nullptr, false};
    for (; bytes_ + bytes > most_bytes_; order_.pop_front()) {
      bytes_ -= entries_.at(order_.front())->content.bytes();
      entries_.erase(order_.front());
    }
    bytes_ += bytes;
    order_.push_back(hash);
    auto entry =
        std::make_shared<const Entry>(Entry{std::move(content), promise.get_future().share()});
    entries_.emplace(hash, entry);
    return {entry, true};
  }

  std::size_t most_bytes_;
  std::size_t bytes_ = 0;
  std::mutex mutex_;
  std::deque<std::uint64_t> order_;
  std::unordered_map<std::uint64_t, std::shared_ptr<const Entry>> entries_;
};

}  // namespace flexspline
