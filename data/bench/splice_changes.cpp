#include <algorithm>
#include <array>
#include <functional>

#include <fmt/format.h>

#include "bench/hidden_draw.hpp"
#include "flexspline/data/splice.hpp"

namespace flexspline::data {
namespace {

constexpr std::array<std::string_view, 5> kChanges = {"none", "mirrored", "every_second",
                                                      "first_70", "one_left_out"};
constexpr std::size_t kFewestSamples = 16;

bool is_signed(Quantity quantity) {
  switch (quantity) {
    case Quantity::time:
    case Quantity::valid:
    case Quantity::temperature:
    case Quantity::supply_voltage:
    case Quantity::drive_enabled:
      return false;
    default:
      return true;
  }
}

void for_each_series(Recording& recording, const std::function<void(std::vector<double>&)>& apply) {
  apply(recording.time);
  for (auto& [quantity, values] : recording.channels) apply(values);
}

void mirror(Recording& recording) {
  for (auto& [quantity, values] : recording.channels) {
    if (!is_signed(quantity)) continue;
    for (double& value : values) value = -value;
  }
}

void thin(Recording& recording) {
  for_each_series(recording, [](std::vector<double>& values) {
    for (std::size_t k = 0; 2 * k < values.size(); ++k) values[k] = values[2 * k];
    values.resize((values.size() + 1) / 2);
  });
}

void shorten(Recording& recording) {
  const std::size_t kept = recording.time.size() * 7 / 10;
  for_each_series(recording, [kept](std::vector<double>& values) { values.resize(kept); });
}

void leave_one_out(RecordingSet& set, std::uint64_t seed) {
  const auto count = set.recordings.size();
  const double lot = drawn(seed, "one_left_out", 0, 0.0, static_cast<double>(count));
  const std::size_t out = std::min(count - 1, static_cast<std::size_t>(lot));
  set.recordings.erase(set.recordings.begin() + static_cast<std::ptrdiff_t>(out));
}

}  // namespace

std::span<const std::string_view> splice_changes() { return kChanges; }

Result<RecordingSet> changed(RecordingSet set, std::string_view change, std::uint64_t seed) {
  if (std::ranges::find(kChanges, change) == kChanges.end()) {
    return failure(ErrorCode::usage, fmt::format("there is no change '{}'", change),
                   fmt::format("choose one of {}", fmt::join(kChanges, ", ")));
  }
  if (change == "one_left_out") {
    if (set.recordings.size() < 2) {
      return failure(ErrorCode::usage, "of one recording none can be left out", "give two or more");
    }
    leave_one_out(set, seed);
  }
  for (Recording& recording : set.recordings) {
    if (change == "mirrored") mirror(recording);
    if (change == "every_second") thin(recording);
    if (change == "first_70") shorten(recording);
    if (recording.time.size() < kFewestSamples) {
      return failure(ErrorCode::usage,
                     fmt::format("recording '{}' is too short for '{}'", recording.id, change),
                     fmt::format("{} samples have to be left", kFewestSamples));
    }
  }
  return set;
}

}  // namespace flexspline::data
