#include <algorithm>
#include <set>

#include "flexspline/studies/trial.hpp"

namespace flexspline::studies {
namespace {

using Names = std::set<std::string>;

Names names_of(const ScoredCase& one) { return {one.named.begin(), one.named.end()}; }

/// The case of the same recordings as they are; null where it is not there or failed.
const ScoredCase* reference_of(const std::vector<ScoredCase>& cases, const ScoredCase& one) {
  const auto found = std::ranges::find_if(cases, [&](const ScoredCase& other) {
    return other.score.kind == CaseKind::kept && !other.score.failed &&
           other.answer.change == "none" && other.answer.source == one.answer.source;
  });
  return found == cases.end() ? nullptr : &*found;
}

/// Names in both over names in either; 1 where neither has any.
double shared(const Names& a, const Names& b) {
  Names either = a;
  either.insert(b.begin(), b.end());
  if (either.empty()) return 1.0;
  const auto both =
      std::ranges::count_if(a, [&b](const std::string& name) { return b.contains(name); });
  return static_cast<double>(both) / static_cast<double>(either.size());
}

/// The effect or a twin of it, by name.
bool names(const ScoredCase& one, const ConcealedAnswer& truth) {
  Names right(truth.twins.begin(), truth.twins.end());
  right.insert(truth.effects.front().id);
  return std::ranges::any_of(one.named,
                             [&right](const std::string& name) { return right.contains(name); });
}

struct Counts {
  int good = 0;
  int of = 0;

  void add(bool is_good) {
    good += is_good ? 1 : 0;
    ++of;
  }
  Proportion rate() const { return proportion(good, of); }
};

}  // namespace

SpliceScores splice_scores(const std::vector<ScoredCase>& cases) {
  constexpr double kLarge = 0.05;
  Counts small, large, same;
  SpliceScores scores;
  double sum = 0.0, sum_decided = 0.0;
  for (const ScoredCase& one : cases) {
    const ScoredCase* reference = reference_of(cases, one);
    if (reference == nullptr || one.score.failed) continue;
    if (one.score.kind == CaseKind::kept) {
      if (one.answer.change == "none") continue;  // a reference, or its like of a later round
      const double both = shared(names_of(one), names_of(*reference));
      const bool decided = one.verdict != name_of(Verdict::undecided);
      same.add(one.verdict == reference->verdict);
      sum += both;
      sum_decided += decided ? both : 0.0;
      scores.undecided += decided ? 0 : 1;
    } else if (one.score.kind == CaseKind::spliced && !names(*reference, one.answer)) {
      Counts& counts = one.answer.effects.front().size_fraction < kLarge ? small : large;
      counts.add(names(one, one.answer));
    }
  }
  scores.found_small = small.rate();
  scores.found_large = large.rate();
  scores.same_verdict = same.rate();
  scores.changed = same.of;
  const int decided = same.of - scores.undecided;
  if (same.of > 0) scores.names_shared = sum / same.of;
  if (decided > 0) scores.names_shared_decided = sum_decided / decided;
  return scores;
}

}  // namespace flexspline::studies
