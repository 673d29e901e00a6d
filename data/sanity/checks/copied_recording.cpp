#include <algorithm>
#include <map>
#include <span>

#include <fmt/format.h>

#include "sanity/check.hpp"

namespace flexspline::data {
namespace {

using Series = std::vector<double>;

constexpr SanityVerdict kCopied{
    "check_channel", Severity::error,
    "give each recording its own file: what is fitted must not be held out"};

constexpr std::size_t kLeast = 32;      // samples in a row that no two measurements share
constexpr std::size_t kMost = 50000;    // samples compared of each
constexpr std::size_t kDifferent = 12;  // values among them

/// The channel that noise makes the most different from itself: what drives or resists, before a
/// position, which coarse encoders read alike wherever the same motion is asked for.
const Series* telling(const ObservedSet& all, const Recording& recording) {
  const Series* position = nullptr;
  for (const Quantity quantity : telling_channels(all.set)) {
    const Series* values = recording.find(quantity);
    if (values == nullptr || !(range_of(*values) > 0.0)) continue;
    if (!is_position(quantity)) return values;
    if (position == nullptr) position = values;
  }
  return position;
}

/// As much of a series as is compared.
std::span<const double> compared(const Series& values) {
  return std::span(values).first(std::min(values.size(), kMost));
}

/// Samples around i of b that are those around k of a.
std::size_t shared_around(std::span<const double> a, std::size_t k, std::span<const double> b,
                          std::size_t i) {
  std::size_t back = 0;
  while (back < k && back < i && a[k - back - 1] == b[i - back - 1]) ++back;
  std::size_t on = 0;
  while (k + on < a.size() && i + on < b.size() && a[k + on] == b[i + on]) ++on;
  const auto part = b.subspan(i - back, back + on);
  Series values(part.begin(), part.end());
  std::ranges::sort(values);
  const auto rest = std::ranges::unique(values);
  return values.size() - rest.size() < kDifferent ? 0 : back + on;
}

/// The longest stretch that two series share, as probes along the second tell.
std::size_t shared(std::span<const double> a, std::span<const double> b) {
  std::multimap<double, std::size_t> places;
  for (std::size_t k = 0; k < a.size(); ++k) places.emplace(a[k], k);
  std::size_t most = 0;
  for (std::size_t i = kLeast / 2; i < b.size(); i += kLeast / 2) {
    const auto [first, last] = places.equal_range(b[i]);
    if (std::distance(first, last) > 64) continue;  // a level that is often there tells nothing
    for (auto place = first; place != last; ++place) {
      most = std::max(most, shared_around(a, place->second, b, i));
    }
  }
  return most;
}

std::vector<SanityFinding> find(const ObservedSet& all) {
  std::vector<SanityFinding> list;
  const auto& recordings = all.set.recordings;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const Series* a = telling(all, recordings[k]);
      const Series* b = telling(all, recordings[i]);
      if (a == nullptr || b == nullptr) continue;
      const std::size_t same = shared(compared(*a), compared(*b));
      if (same < kLeast) continue;
      list.push_back(kCopied.on(
          recordings[i].id,
          fmt::format("{} samples in a row are those of recording '{}'", same, recordings[k].id)));
    }
  }
  return list;
}

}  // namespace

SanityRow describe_copied_recording() {
  return {"copied_recording", "a recording that is a copy of another", {kCopied}, find};
}

}  // namespace flexspline::data
