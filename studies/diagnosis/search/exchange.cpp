#include "diagnosis/search/exchange.hpp"

#include <algorithm>

#include "flexspline/core/in_parallel.hpp"

namespace flexspline::studies {
namespace {

bool is_in(const DriveModel& model, const CauseRow* row) {
  return std::ranges::count(model.causes, row, &ActiveCause::row) > 0;
}

bool is_contested(const Selection& s, std::size_t cause) {
  return !s.accepted[cause].trial.cause.row->of_baseline();
}

// Parts of the baseline that act where a cause does, from where their search starts.
std::vector<ActiveCause> parts_in_place_of(const CauseRow& row, const Frame& frame,
                                           const DriveModel& model) {
  std::vector<ActiveCause> parts;
  for (const CauseRow& part : baseline_parts()) {
    if (part.coordinate != row.coordinate || is_in(model, &part)) continue;
    for (const CauseForm* form : forms_on(part, frame)) {
      if (form->start != nullptr) parts.push_back({&part, form, form->start(frame)});
    }
  }
  return parts;
}

/// A cause first, then its alternatives and the parts of the baseline that may stand for it.
std::vector<ActiveCause> contenders(const Frame& frame, const Selection& s, std::size_t cause) {
  const DriveModel& model = s.final.fit.model;
  std::vector<ActiveCause> entries = {model.causes[cause]};
  for (const Trial& rival : s.accepted[cause].rivals) {
    if (!is_in(model, rival.cause.row)) entries.push_back(rival.cause);
  }
  std::ranges::move(parts_in_place_of(*entries.front().row, frame, model),
                    std::back_inserter(entries));
  return entries;
}

/// Each contender tried on the model without the cause; none where it stands alone.
Result<std::vector<Trial>> contest(const Frame& frame, const Limits& limits, const Selection& s,
                                   std::size_t cause) {
  const auto entries = contenders(frame, s, cause);
  if (entries.size() < 2) return std::vector<Trial>{};
  auto without = reduced(frame, s.final, cause, kRefreshSteps);
  if (!without) return tl::unexpected(without.error());
  Findings rest = s.final;
  rest.fit = std::move(*without);
  std::vector<Trial> trials(entries.size());
  in_parallel(entries.size(), threads_for(limits.threads),
              [&](std::size_t k) { trials[k] = try_cause(frame, rest, entries[k]); });
  return trials;
}

// The model has its causes in the order of the list.
void put_in_place(Selection& s, std::size_t cause, std::vector<Trial> trials, std::size_t best,
                  const Limits& limits) {
  std::vector<Trial> field = std::move(s.accepted[cause].field);
  s.accepted.erase(s.accepted.begin() + static_cast<long>(cause));
  s.final.fit = trials[best].fit;
  s.accepted.push_back(accept(std::move(trials), best, limits));
  std::ranges::move(field, std::back_inserter(s.accepted.back().field));
}

/// Where the best of a contest stands; 0: the cause itself.
std::size_t winner(const std::vector<Trial>& trials, const Limits& limits) {
  const auto best = std::ranges::max_element(trials, {}, &Trial::net_gain);
  if (best == trials.end() || !(best->gain > 0.0)) return 0;
  const auto part = std::ranges::find_if(
      trials, [&](const Trial& trial) { return goes_before(trial, *best, limits); });
  return static_cast<std::size_t>((part != trials.end() ? part : best) - trials.begin());
}

/// The contests of the first `count` causes, side by side; nothing of one that its cause wins.
std::vector<Result<std::vector<Trial>>> contests(const Frame& frame, const Limits& limits,
                                                 const Selection& s, std::size_t count) {
  std::vector<Result<std::vector<Trial>>> all(count);
  in_parallel(count, threads_for(limits.threads), [&](std::size_t i) {
    if (!is_contested(s, i)) return;
    auto trials = contest(frame, limits, s, i);
    if (!trials || winner(*trials, limits) > 0) all[i] = std::move(trials);
  });
  return all;
}

}  // namespace

Result<void> exchange_for_better(const Frame& frame, const Limits& limits, Selection& s) {
  if (s.accepted.size() < 2) return {};
  // The last has been compared beside all others.
  auto all = contests(frame, limits, s, s.accepted.size() - 1);
  for (std::size_t i = all.size(); i-- > 0;) {
    if (!all[i]) return tl::unexpected(all[i].error());
    const std::size_t best = winner(*all[i], limits);
    if (best == 0) continue;
    put_in_place(s, i, *std::move(all[i]), best, limits);
    const auto again = refresh(frame, s.final, kRefreshSteps);
    if (!again) return again;
    all = contests(frame, limits, s, i);
  }
  return {};
}

}  // namespace flexspline::studies
