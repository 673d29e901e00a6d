#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sanity/check.hpp"

namespace flexspline::data {
namespace {

using Series = std::vector<double>;

constexpr SanityVerdict kGaps{"check_channel", Severity::warning,
                              "cut it into recordings there: the motion in between is unknown"};
constexpr SanityVerdict kTwice{"check_channel", Severity::warning, "keep one row a stamp"};
constexpr SanityVerdict kRepeated{
    "check_channel", Severity::warning,
    "keep the rows that were measured: the log is faster than the sensors"};

constexpr double kGap = 20.0;        // times the usual interval
constexpr double kDuplicate = 0.02;  // of it
constexpr double kRepeats = 0.2;     // of the rows that are the row before again
constexpr std::size_t kLongestRepeat = 9;
constexpr std::size_t kMostIntervals = 1'000'000;

/// The middle interval, of a million evenly chosen ones at most.
double usual_interval(const Series& time) {
  const std::size_t stride = (time.size() + kMostIntervals - 1) / kMostIntervals;
  Series steps;
  for (std::size_t i = 1; i < time.size(); i += stride) steps.push_back(time[i] - time[i - 1]);
  return median_of(std::move(steps));
}

void look_for_gaps(const Recording& recording, std::vector<SanityFinding>& list) {
  const Series& time = recording.time;
  const double usual = usual_interval(time);
  std::size_t gaps = 0, twice = 0, before_widest = 0;
  double widest = 0.0;
  for (std::size_t i = 1; i < time.size(); ++i) {
    const double step = time[i] - time[i - 1];
    gaps += step > kGap * usual ? 1 : 0;
    twice += step < kDuplicate * usual ? 1 : 0;
    if (!(step > widest)) continue;
    widest = step;
    before_widest = i - 1;
  }
  if (gaps > 0) {
    list.push_back(kGaps.on(
        recording.id,
        fmt::format("{} gap{} in time, the longest of {:.3g} s at {:.6g} s, {:.0f} times the "
                    "usual interval",
                    gaps, gaps == 1 ? "" : "s", widest, time[before_widest], widest / usual)));
  }
  if (twice == 0) return;
  list.push_back(kTwice.on(
      recording.id, fmt::format("{} time stamps repeat the one before, or nearly so", twice)));
}

bool same_row(const Recording& recording, std::size_t i) {
  return std::ranges::all_of(recording.channels, [i](const auto& channel) {
    return channel.second[i] == channel.second[i - 1];
  });
}

// A log that is faster than its sensors repeats each row some times; a bench at rest, for long.
void look_for_repeats(const Recording& recording, std::vector<SanityFinding>& list) {
  std::size_t repeats = 0;
  std::size_t run = 0;
  for (std::size_t i = 1; i <= recording.time.size(); ++i) {
    const bool same = i < recording.time.size() && same_row(recording, i);
    if (!same && run <= kLongestRepeat) repeats += run;
    run = same ? run + 1 : 0;
  }
  const double share = static_cast<double>(repeats) / static_cast<double>(recording.time.size());
  if (share < kRepeats) return;
  list.push_back(kRepeated.on(
      recording.id, fmt::format("{:.0f} % of the rows are the row before again, with a later "
                                "time",
                                100.0 * share)));
}

std::vector<SanityFinding> find(const ObservedSet& all) {
  std::vector<SanityFinding> list;
  for (const Recording& recording : all.set.recordings) {
    if (recording.time.size() < 3) continue;
    look_for_gaps(recording, list);
    look_for_repeats(recording, list);
  }
  return list;
}

}  // namespace

SanityRow describe_time_stamps() {
  return {
      "time_stamps", "gaps in time, stamps and rows that repeat", {kGaps, kTwice, kRepeated}, find};
}

}  // namespace flexspline::data
