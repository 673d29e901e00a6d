#include "diagnosis/names/unnamed_causes.hpp"

#include <algorithm>
#include <span>

#include "diagnosis/names/confirm.hpp"
#include "diagnosis/names/undecided.hpp"
#include "diagnosis/search/explanation.hpp"
#include "diagnosis/unnamed/unnamed.hpp"

namespace flexspline::studies {
namespace {

bool may_be_named(const Accepted& cause, const Limits& limits) {
  return cause.material && cause.probability >= limits.probability;
}

// The causes of the proof whose names are improbable, or of no interest in the end, go to the end
// of the list and of the model.
std::size_t put_improbable_last(Selection& s, Proof& proof, const Limits& limits) {
  DriveModel& model = s.final.fit.model;
  std::size_t named = s.accepted.size();
  for (std::size_t i = s.accepted.size(); i-- > 0;) {
    Accepted& a = s.accepted[i];
    a.probability = a.trial.cause.row->in_catalogue() ? probability_of(proof.causes[i]) : 0.0;
    a.material = a.trial.size >= limits.interest;
    if (may_be_named(a, limits)) continue;
    const auto to_the_end = [&](auto& list, std::size_t at) {
      const auto first = list.begin() + static_cast<std::ptrdiff_t>(at);
      std::rotate(first, first + 1, list.end());
    };
    to_the_end(s.accepted, i);
    to_the_end(proof.causes, i);
    to_the_end(model.causes, s.immaterial.size() + i);
    to_the_end(model.coefficients, s.immaterial.size() + i);
    --named;
  }
  return named;
}

// With the first causes alone.
Result<Selection> first_causes(const Frame& frame, const Limits& limits, Selection s,
                               std::size_t count) {
  while (s.accepted.size() > count) {
    const auto left_out =
        leave_out(frame, s, s.accepted.size() - 1, "its name is hardly likelier right than wrong");
    if (!left_out) return tl::unexpected(left_out.error());
  }
  locate_misfit(frame, limits, s);
  return s;
}

void take_names(Selection& s, std::size_t from) {
  const auto first = s.accepted.begin() + static_cast<std::ptrdiff_t>(from);
  s.unnamed.assign(std::make_move_iterator(first), std::make_move_iterator(s.accepted.end()));
  s.accepted.erase(first, s.accepted.end());
}

// Recordings held out confirm these causes: where nothing is named, one of interest is something.
bool is_something(const Selection& s, std::size_t named) {
  return named == 0 &&
         std::ranges::any_of(s.accepted, [](const Accepted& a) { return a.material; });
}

// On recordings held out, with a table of what the model leaves where there is one.
double error_with_a_table(const Frame& frame, const Limits& limits, const Selection& s,
                          const Proof& proof) {
  const auto table = unnamed_part(frame, s, proof, limits);
  const bool same = table && table->equation == name_of(equation_to_prove(frame, s));
  return proof.holdout.rmse_after * (same ? table->holdout_ratio : 1.0);
}

// Whether a table follows what is missing better than forms that never had a name do. A doubted
// name says more than a table.
bool is_told_better_by_table(const Frame& frame, const Limits& limits, const Selection& s,
                             const Proof& proof, const Selection& named,
                             const Proof& proof_of_named) {
  const auto behind = std::span(s.accepted).subspan(named.accepted.size());
  const auto has_a_name = [](const Accepted& a) { return a.trial.cause.row->in_catalogue(); };
  if (std::ranges::any_of(behind, has_a_name)) return false;
  return equation_to_prove(frame, s) == equation_to_prove(frame, named) &&
         error_with_a_table(frame, limits, named, proof_of_named) <
             error_with_a_table(frame, limits, s, proof);
}

// What the named causes leave.
void take_misfit(Selection& s, Selection named) {
  s.before = std::move(named.before);
  s.after = std::move(named.after);
  s.remainder = named.remainder;
}

}  // namespace

Result<Proof> take_improbable_names(const Frame& frame, const Limits& limits, Selection& s,
                                    Proof proof) {
  std::size_t count = put_improbable_last(s, proof, limits);
  while (count < s.accepted.size()) {
    auto named = first_causes(frame, limits, s, count);
    if (!named) return tl::unexpected(named.error());
    auto proof_of_named = prove(frame, *named, limits.threads);
    if (!proof_of_named) return proof_of_named;
    proof_of_named->causes.assign(proof.causes.begin(),
                                  proof.causes.begin() + static_cast<std::ptrdiff_t>(count));
    const bool left = named->remainder || is_something(s, count) ||
                      is_beyond_noise(frame, proof_of_named->holdout, limits);
    if (!left || !implausible(frame, s, limits).empty() ||
        is_told_better_by_table(frame, limits, s, proof, *named, *proof_of_named)) {
      s = std::move(*named);
      return proof_of_named;
    }
    // What only a form without a name follows is left over beside the names.
    take_left_over(frame, named->final, s, *proof_of_named);
    std::ranges::copy(proof_of_named->causes, proof.causes.begin());
    const std::size_t fewer = put_improbable_last(s, proof, limits);
    if (fewer < count) {
      count = fewer;
      continue;
    }
    proof.causes.resize(count);
    take_names(s, count);
    take_misfit(s, std::move(*named));
    return proof;
  }
  locate_misfit(frame, limits, s);
  return proof;
}

}  // namespace flexspline::studies
