#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sanity/check.hpp"
#include "sanity/lag.hpp"

namespace flexspline::data {
namespace {

constexpr SanityVerdict kDrift{"check_channel", Severity::error,
                               "record all channels by one clock, or bring them to one before"};
constexpr SanityVerdict kOverlaps{"check_channel", Severity::warning,
                                  "check start_s of both: what drifts is told by it"};

constexpr double kLeastPhase = 0.2;  // rad at the end of the recording that shows most of it
constexpr double kLeft = 0.4;        // of what is unexplained without a drift
constexpr double kOverlap = 0.02;    // of the shorter recording

void between_channels(const ObservedSet& all, std::vector<SanityFinding>& list) {
  for (const Relation& relation : relations_of(all)) {
    const auto drift = best_lag(relation, LagKind::drift);
    if (!drift || drift->phase < kLeastPhase || drift->left > kLeft) continue;
    list.push_back(kDrift.on(
        "", fmt::format("{} drifts against {}: its clock differs by {:.2g} %, {:.2g} rad at "
                        "the end, which leaves {:.0f} % of what is unexplained without",
                        relation.late, relation.than, 100.0 * std::abs(drift->amount), drift->phase,
                        100.0 * drift->left)));
    return;
  }
}

/// Recordings in the order of the clock that they are said to share.
std::vector<const Recording*> by_start(const RecordingSet& set) {
  std::vector<const Recording*> list;
  for (const Recording& one : set.recordings) {
    if (!one.time.empty()) list.push_back(&one);
  }
  std::ranges::stable_sort(list, {}, &Recording::start_s);
  return list;
}

// One bench makes one recording at a time. Without a start they all begin at 0, which says nothing.
void between_recordings(const ObservedSet& all, std::vector<SanityFinding>& list) {
  const auto order = by_start(all.set);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const Recording& before = *order[k - 1];
    const Recording& after = *order[k];
    if (before.start_s == after.start_s) continue;
    const double lasts = before.time.back() - before.time.front();
    const double shared = before.start_s + lasts - after.start_s;
    const double shorter = std::min(lasts, after.time.back() - after.time.front());
    if (shared <= kOverlap * shorter) continue;
    list.push_back(kOverlaps.on(
        after.id, fmt::format("it starts at {:.6g} s, {:.3g} s before recording '{}' ends on the "
                              "same clock",
                              after.start_s, shared, before.id)));
  }
}

std::vector<SanityFinding> find(const ObservedSet& all) {
  std::vector<SanityFinding> list;
  between_channels(all, list);
  between_recordings(all, list);
  return list;
}

}  // namespace

SanityRow describe_clock_drift() {
  return {
      "clock_drift", "channels, or recordings, by clocks that differ", {kDrift, kOverlaps}, find};
}

}  // namespace flexspline::data
