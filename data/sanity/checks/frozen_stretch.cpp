#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "sanity/check.hpp"

namespace flexspline::data {
namespace {

using Series = std::vector<double>;

constexpr SanityVerdict kFrozen{"check_channel", Severity::error,
                                "mark these samples with valid = 0, or leave the recording out"};

constexpr std::size_t kLeastRun = 12;   // samples
constexpr double kLongerThan = 6.0;     // times the longest but few runs of the channel elsewhere
constexpr double kJump = 6.0;           // times the usual step of the channel
constexpr double kTurns = 0.3;          // of the samples
constexpr double kPartnerMoves = 0.15;  // of its range, while the channel stands still
constexpr double kPartnerFar = 0.3;     // of it, while a torque does: no torque sticks at one value

struct Run {
  std::size_t first = 0;
  std::size_t count = 0;
};

/// The longest run, and how long others usually are: what quantisation makes.
struct Longest {
  Run run;
  std::size_t usual = 1;
};

// Runs are counted by their length: of noise there are as many as samples.
Longest longest_of(const Series& values) {
  Longest longest;
  std::map<std::size_t, std::size_t> runs_of_length;
  for (std::size_t first = 0; first < values.size();) {
    std::size_t next = first + 1;
    while (next < values.size() && values[next] == values[first]) ++next;
    const Run run{first, next - first};
    if (run.count > longest.run.count) longest.run = run;
    ++runs_of_length[run.count];
    first = next;
  }
  --runs_of_length[longest.run.count];
  std::size_t others = 0;
  for (const auto& [length, runs] : runs_of_length) others += runs;
  std::size_t shorter = 0;
  for (const auto& [length, runs] : runs_of_length) {
    shorter += runs;
    if (shorter <= others * 9 / 10) continue;
    longest.usual = length;
    break;
  }
  return longest;
}

/// A channel that goes on from somewhere else than where it stood. What sticks goes on from there.
bool jumps_after(const Series& values, const Run& run) {
  const std::size_t next = run.first + run.count;
  if (next >= values.size()) return false;
  Series steps;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] != values[i - 1]) steps.push_back(std::abs(values[i] - values[i - 1]));
  }
  return std::abs(values[next] - values[run.first]) > kJump * median_of(std::move(steps));
}

// A channel that turns at every other sample outside the run has noise, which never stands still.
bool is_noisy(const Series& values, const Run& run) {
  std::size_t turns = 0;
  for (std::size_t i = 2; i < values.size(); ++i) {
    turns += (values[i] - values[i - 1]) * (values[i - 1] - values[i - 2]) < 0.0 ? 1 : 0;
  }
  return static_cast<double>(turns) > kTurns * static_cast<double>(values.size() - run.count);
}

bool is_long(const Longest& longest, std::size_t samples) {
  const auto least =
      std::max(static_cast<double>(kLeastRun), kLongerThan * static_cast<double>(longest.usual));
  return static_cast<double>(longest.run.count) >= least && longest.run.count < samples;
}

bool is_marked(const Recording& recording, const Run& run) {
  const Series* valid = recording.find(Quantity::valid);
  return valid != nullptr && (*valid)[run.first + run.count / 2] < 0.5;
}

/// The largest share of its range that another channel moves through during the run.
double partner_moves(const ObservedSet& all, const Recording& recording, Quantity quantity,
                     const Run& run) {
  double most = 0.0;
  for (const Quantity other : telling_channels(all.set)) {
    const Series* values = recording.find(other);
    if (other == quantity || values == nullptr) continue;
    const double range = range_of(*values);
    if (!(range > 0.0)) continue;
    const auto part = std::span(*values).subspan(run.first, run.count);
    most = std::max(most, range_of(part) / range);
  }
  return most;
}

std::vector<SanityFinding> find(const ObservedSet& all) {
  std::vector<SanityFinding> list;
  for (const Recording& recording : all.set.recordings) {
    for (const Quantity quantity : sensed_channels(all.set)) {
      const Series* values = recording.find(quantity);
      if (values == nullptr || values->size() < kLeastRun) continue;
      const Longest longest = longest_of(*values);
      const Run& run = longest.run;
      if (!is_long(longest, values->size()) || is_marked(recording, run)) continue;
      const double moved = partner_moves(all, recording, quantity, run);
      const bool never_stands =
          longest.usual == 1 &&
          (is_noisy(*values, run) || (!is_position(quantity) && moved > kPartnerFar));
      if (!never_stands && (moved < kPartnerMoves || !jumps_after(*values, run))) continue;
      const double from = recording.time[run.first];
      const double to = recording.time[run.first + run.count - 1];
      list.push_back(kFrozen.on(
          recording.id,
          fmt::format("{} stands at {:.6g} for {} samples ({:.4g} to {:.4g} s) while another "
                      "channel goes through {:.0f} % of its range",
                      name_of(quantity), (*values)[run.first], run.count, from, to,
                      100.0 * moved)));
    }
  }
  return list;
}

}  // namespace

SanityRow describe_frozen_stretch() {
  return {"frozen_stretch", "a channel that stands still while the others move", {kFrozen}, find};
}

}  // namespace flexspline::data
