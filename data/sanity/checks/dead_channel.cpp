#include <optional>

#include <fmt/format.h>

#include "sanity/check.hpp"

namespace flexspline::data {
namespace {

constexpr SanityVerdict kDead{
    "check_channel", Severity::error,
    "see whether the sensor was connected and the right column is named; leave the recording out"};

/// The value of a channel that is the same wherever the bench did not mark a sample as spoiled.
bool is_dead(const Recording& recording, const std::vector<double>& values) {
  const auto* valid = recording.find(Quantity::valid);
  std::optional<double> first;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (valid != nullptr && !((*valid)[i] > 0.5)) continue;
    if (!first) first = values[i];
    if (values[i] != *first) return false;
  }
  return true;
}

std::vector<SanityFinding> find(const ObservedSet& all) {
  std::vector<SanityFinding> list;
  for (const Recording& recording : all.set.recordings) {
    for (const Quantity quantity : telling_channels(all.set)) {
      const auto* values = recording.find(quantity);
      if (values == nullptr || values->empty() || !is_dead(recording, *values)) continue;
      list.push_back(kDead.on(recording.id, fmt::format("{} is {:.6g} in every sample",
                                                        name_of(quantity), values->front())));
    }
  }
  return list;
}

}  // namespace

SanityRow describe_dead_channel() {
  return {
      "dead_channel", "a channel that is the same number throughout a recording", {kDead}, find};
}

}  // namespace flexspline::data
