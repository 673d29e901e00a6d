#include <fmt/format.h>

#include <algorithm>

#include "flexspline/data/dataset.hpp"

namespace flexspline::data {
namespace {

constexpr std::size_t kFewest = 10;  // rows left between two crossings of a motion's middle
constexpr double kBeyond = 0.1;      // of its range, to either side: noise crosses nothing

/// How often a motion crosses its middle.
std::size_t crossings_of(const std::vector<double>& motion) {
  const auto [low, high] = std::ranges::minmax(motion);
  const double middle = 0.5 * (low + high);
  const double beyond = kBeyond * (high - low);
  std::size_t crossings = 0;
  int side = 0;
  for (const double x : motion) {
    const int here = x > middle + beyond ? 1 : x < middle - beyond ? -1 : side;
    if (side != 0 && here != side) ++crossings;
    side = here;
  }
  return crossings;
}

/// Of its motions the one that crosses most often.
std::size_t crossings_of(const Recording& recording) {
  using enum Quantity;
  std::size_t most = 0;
  for (const Quantity quantity : {motor_angle, load_angle, angle, torsion, displacement}) {
    const auto* motion = recording.find(quantity);
    if (motion != nullptr && !motion->empty()) most = std::max(most, crossings_of(*motion));
  }
  return most;
}

/// Every stride-th of the first rows.
struct Thinning {
  std::size_t stride = 1;
  std::size_t rows = 0;
};

// A motion that so few rows would not follow is followed for a part of its time.
Thinning thinning_of(const Recording& recording, std::size_t most) {
  const std::size_t rows = recording.time.size();
  const std::size_t even = (rows + most - 1) / most;
  const std::size_t follows = std::max<std::size_t>(
      1, rows / (kFewest * std::max<std::size_t>(1, crossings_of(recording))));
  if (even <= follows) return {even, rows};
  return {follows, std::min(rows, follows * most)};
}

void thin(std::vector<double>& values, const Thinning& thinning) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < thinning.rows; i += thinning.stride) values[kept++] = values[i];
  values.resize(kept);
  values.shrink_to_fit();
}

std::string ordinal(std::size_t number) {
  const std::size_t last = number % 100 / 10 == 1 ? 0 : number % 10;
  const char* ending = last == 1 ? "st" : last == 2 ? "nd" : last == 3 ? "rd" : "th";
  return fmt::format("{}{}", number, ending);
}

std::string in_words(const Thinning& thinning, std::size_t rows) {
  if (thinning.rows == rows) {
    return fmt::format("every {} of {} rows is used", ordinal(thinning.stride), rows);
  }
  const std::string used =
      thinning.stride == 1 ? fmt::format("the first {} of {} rows are used", thinning.rows, rows)
                           : fmt::format("every {} of the first {} of {} rows is used",
                                         ordinal(thinning.stride), thinning.rows, rows);
  return used + ": fewer would not follow the motion";
}

}  // namespace

void thin_recordings(RecordingSet& set, std::size_t most) {
  bool any = false;
  for (Recording& recording : set.recordings) {
    const std::size_t rows = recording.time.size();
    if (most == kAllRows || rows <= most) continue;
    const Thinning thinning = thinning_of(recording, most);
    thin(recording.time, thinning);
    for (auto& [quantity, values] : recording.channels) thin(values, thinning);
    set.notes.push_back(fmt::format("recording {}: {}; --rows all uses them all", recording.id,
                                    in_words(thinning, rows)));
    any = true;
  }
  if (any) set.sha256 = content_hash(set);
}

}  // namespace flexspline::data
