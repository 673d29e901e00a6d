#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engines/claims.hpp"
#include "flexspline/studies/engine.hpp"

namespace flexspline::studies {

/// What there is to take at the moment.
struct Taken {
  std::vector<std::size_t> cases;  ///< of one pack; none: see later
  bool later = false;              ///< somebody may be gone: ask again soon
};

/// Takes packs of a study's cases, first those that nobody had, then those whose taker is gone.
class PackPuller {
 public:
  /// done: what is done in the folder now, case by case.
  using Look = std::function<Result<std::vector<bool>>()>;

  PackPuller(std::size_t total, Claims claims, const Pulling& pulling, std::vector<bool> done,
             Look look);

  /// seconds: what a case took up to now, with all workers at once; NaN: not known.
  /// Errors: cannot_write; those of looking.
  Result<Taken> take(double seconds);
  /// Cases that nobody took yet, as it was last seen.
  std::size_t untaken() const { return total_ - end_; }

 private:
  Result<std::optional<Taken>> take_new(double seconds);
  Result<Taken> take_over();
  Result<void> look();
  std::vector<std::size_t> undone(std::size_t from, std::size_t to) const;

  std::size_t total_;
  Claims claims_;
  Pulling pulling_;
  std::vector<bool> done_;
  Look look_;
  std::size_t end_ = 0;   ///< of the packs that are taken
  std::size_t last_ = 1;  ///< cases of the pack taken last
  std::chrono::steady_clock::time_point looked_;
  std::set<std::string> gone_;  ///< who went, and was looked after
};

}  // namespace flexspline::studies
