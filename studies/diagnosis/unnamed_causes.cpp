#include "diagnosis/unnamed_causes.hpp"

#include <iterator>
#include <utility>

#include "diagnosis/explanation.hpp"
#include "diagnosis/undecided.hpp"

namespace flexspline::studies {
namespace {

constexpr int kSteps = 8;
constexpr int kFinalSteps = 12;

// Behind the accepted causes, in the order in which they were withdrawn.
Result<Selection> with_all(const Frame& frame, Selection s, const std::vector<Accepted>& causes) {
  for (const Accepted& one : causes) {
    auto fit = extended(frame, s.final, one.trial.cause, kSteps);
    if (!fit) return tl::unexpected(fit.error());
    s.final.fit = std::move(*fit);
    s.accepted.push_back(one);
  }
  const auto fitted = refresh(frame, s.final, kSteps);
  if (!fitted) return tl::unexpected(fitted.error());
  return s;
}

// The causes from the first on become unnamed ones.
void take_names(Selection& s, std::size_t first) {
  const auto from = s.accepted.begin() + static_cast<long>(first);
  s.unnamed.assign(std::make_move_iterator(from), std::make_move_iterator(s.accepted.end()));
  s.accepted.erase(from, s.accepted.end());
}

void withdraw(Selection& s, std::vector<Accepted> causes) {
  s.withdrawn.insert(s.withdrawn.begin(), std::make_move_iterator(causes.begin()),
                     std::make_move_iterator(causes.end()));
}

// Without those, from the first on, that recordings held out do not confirm.
Result<Proof> prove_confirmed(const Frame& frame, const Limits& limits, Selection& s,
                              std::size_t first) {
  while (true) {
    auto proof = prove(frame, s, limits.threads);
    if (!proof) return proof;
    const auto worst = unconfirmed(*proof, limits, first);
    if (!worst) {
      const auto fitted = fit_all(frame, s.final, kFinalSteps, kJudgedFall);
      if (!fitted) return tl::unexpected(fitted.error());
      return proof;
    }
    const auto left_out = leave_out(frame, s, *worst, s.accepted[*worst].withdrawn_because);
    if (!left_out) return tl::unexpected(left_out.error());
  }
}

}  // namespace

Result<Proof> with_unnamed(const Frame& frame, const Limits& limits,
                           std::vector<Accepted> improbable, Proof named, Selection& s) {
  const bool left = s.remainder || is_beyond_noise(frame, named.holdout, limits);
  if (improbable.empty() || !left) {
    withdraw(s, std::move(improbable));
    return named;
  }
  auto whole = with_all(frame, s, improbable);
  if (!whole) return tl::unexpected(whole.error());
  if (!implausible(frame, *whole, limits).empty()) {
    withdraw(s, std::move(improbable));
    return named;
  }
  const std::size_t first = s.accepted.size();
  auto proof = prove_confirmed(frame, limits, *whole, first);
  if (!proof) return proof;
  proof->causes = std::move(named.causes);
  take_names(*whole, first);
  s = std::move(*whole);
  return proof;
}

}  // namespace flexspline::studies
