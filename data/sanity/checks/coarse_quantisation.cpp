#include <cmath>
#include <set>

#include <fmt/format.h>

#include "sanity/check.hpp"

namespace flexspline::data {
namespace {

constexpr SanityVerdict kCoarse{
    "check_channel", Severity::warning,
    "record it with a finer resolution; what is finer than a step is not seen"};

constexpr double kFewest = 24.0;            // steps over the range
constexpr std::size_t kLeastSamples = 200;  // fewer may take few values by chance
constexpr double kRepeated = 4.0;           // samples a value

/// Number of values that a channel takes; beyond the fewest it is not counted on.
double values_taken(const std::vector<double>& values) {
  std::set<double> taken;
  for (const double value : values) {
    if (std::isnan(value)) continue;  // a dropout
    if (taken.insert(value).second && static_cast<double>(taken.size()) > kFewest) break;
  }
  return static_cast<double>(taken.size());
}

std::vector<SanityFinding> find(const ObservedSet& all) {
  std::vector<SanityFinding> list;
  for (const Recording& recording : all.set.recordings) {
    for (const Quantity quantity : telling_channels(all.set)) {
      const auto* values = recording.find(quantity);
      if (values == nullptr || values->size() < kLeastSamples || !(range_of(*values) > 0.0)) {
        continue;
      }
      const double taken = values_taken(*values);
      if (taken > kFewest || taken * kRepeated > static_cast<double>(values->size())) continue;
      list.push_back(
          kCoarse.on(recording.id,
                     fmt::format("{} takes {:.0f} values in {} samples: a step is {:.2g} % of its "
                                 "range",
                                 name_of(quantity), taken, values->size(), 100.0 / (taken - 1.0))));
    }
  }
  return list;
}

}  // namespace

SanityRow describe_coarse_quantisation() {
  return {"coarse_quantisation", "a channel of few values", {kCoarse}, find};
}

}  // namespace flexspline::data
