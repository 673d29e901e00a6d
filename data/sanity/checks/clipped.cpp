#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "sanity/check.hpp"

namespace flexspline::data {
namespace {

using Series = std::vector<double>;

constexpr SanityVerdict kCutOff{"check_channel", Severity::error,
                                "widen the sensor's range, or mark these samples with valid = 0"};

constexpr std::size_t kLeastSamples = 8;   // exactly at an extreme, some of them in a row
constexpr std::size_t kLeastTurning = 24;  // of what moves: it dwells at an extreme as it turns
constexpr std::size_t kLeastRow = 4;
constexpr double kAgainstLevels = 4.0;  // times as many as at any of the levels next to it
constexpr std::size_t kLevels = 12;
constexpr double kPartnerMoves = 0.08;  // of its range, while the channel is at its extreme

struct AtExtreme {
  double value = 0.0;
  std::size_t count = 0;
  std::size_t row = 0;   ///< longest in a row
  std::size_t rows = 0;  ///< of the least length or longer
  std::size_t first = 0;
};

AtExtreme at(const Series& values, double value) {
  AtExtreme found{value, 0, 0, 0, 0};
  std::size_t row = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    row = values[i] == value ? row + 1 : 0;
    found.count += values[i] == value ? 1 : 0;
    found.rows += row == kLeastRow ? 1 : 0;
    if (row > found.row) found.row = row, found.first = i + 1 - row;
  }
  return found;
}

/// Most samples at one of the levels below (above) the extreme; 0 would mean a channel without any.
std::size_t at_levels_beside(const Series& values, double extreme, bool top) {
  std::map<double, std::size_t> counts;
  for (const double value : values) {
    if (value != extreme) ++counts[top ? -value : value];
  }
  std::size_t most = 1;
  std::size_t level = 0;
  for (const auto& [value, count] : counts) {
    if (level++ == kLevels) break;
    most = std::max(most, count);
  }
  return most;
}

/// Range of another channel over the longest row, of its own.
double partner_moves(const ObservedSet& all, const Recording& recording, Quantity quantity,
                     const AtExtreme& extreme) {
  double most = 0.0;
  for (const Quantity other : telling_channels(all.set)) {
    const Series* values = recording.find(other);
    if (other == quantity || values == nullptr || !(range_of(*values) > 0.0)) continue;
    const auto part = std::span(*values).subspan(extreme.first, extreme.row);
    most = std::max(most, range_of(part) / range_of(*values));
  }
  return most;
}

bool is_clipped(const ObservedSet& all, const Recording& recording, Quantity quantity,
                const Series& values, const AtExtreme& extreme, bool top) {
  const std::size_t least = is_position(quantity) ? kLeastTurning : kLeastSamples;
  if (extreme.count < least || extreme.row < kLeastRow) return false;
  if (is_position(quantity) && extreme.rows < 2) return false;  // what sticks stands once
  const auto beside = static_cast<double>(at_levels_beside(values, extreme.value, top));
  if (static_cast<double>(extreme.count) < kAgainstLevels * beside) return false;
  return partner_moves(all, recording, quantity, extreme) > kPartnerMoves;
}

std::vector<SanityFinding> find(const ObservedSet& all) {
  std::vector<SanityFinding> list;
  for (const Recording& recording : all.set.recordings) {
    for (const Quantity quantity : sensed_channels(all.set)) {
      const Series* values = recording.find(quantity);
      if (values == nullptr || !(range_of(*values) > 0.0)) continue;
      for (const bool top : {true, false}) {
        const double value =
            top ? *std::ranges::max_element(*values) : *std::ranges::min_element(*values);
        const AtExtreme extreme = at(*values, value);
        if (!is_clipped(all, recording, quantity, *values, extreme, top)) continue;
        list.push_back(kCutOff.on(
            recording.id, fmt::format("{} is cut off: {} of {} samples are exactly {:.6g}, its {}",
                                      name_of(quantity), extreme.count, values->size(), value,
                                      top ? "largest" : "smallest")));
        break;
      }
    }
  }
  return list;
}

}  // namespace

SanityRow describe_clipped() {
  return {
      "clipped", "many samples exactly at an extreme, as a saturated sensor has", {kCutOff}, find};
}

}  // namespace flexspline::data
