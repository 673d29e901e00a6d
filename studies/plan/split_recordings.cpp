#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "flexspline/studies/plan.hpp"
#include "plan/motion_range.hpp"

namespace flexspline::studies {

double motion_range(const TorsionRecord& record) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < record.motion.size(); ++i) {
    if (i < record.valid.size() && !record.valid[i]) continue;
    low = std::min(low, record.motion[i]);
    high = std::max(high, record.motion[i]);
  }
  return high > low ? high - low : 0.0;
}

namespace {

std::string follow_the_marks(std::span<TorsionRecord> records) {
  std::size_t train = 0;
  for (TorsionRecord& record : records) {
    if (record.split != Split::train)
      record.split = Split::holdout;
    else
      ++train;
  }
  return fmt::format("{} of {} recordings are marked for training; the others are held out", train,
                     records.size());
}

/// Positions, in ascending order of range, of those of n recordings that are held out.
std::vector<std::size_t> positions_held_out(std::size_t n) {
  if (n < 2) return {};
  if (n == 2) return {0};
  const std::size_t inner = n - 2;
  const auto count = static_cast<std::size_t>(std::lround(static_cast<double>(n) / 3.0));
  std::vector<std::size_t> positions;
  for (std::size_t j = 0; j < count; ++j) {
    positions.push_back(1 + ((2 * j + 1) * inner) / (2 * count));
  }
  return positions;
}

}  // namespace

std::string split_recordings(std::span<TorsionRecord> records) {
  const auto is = [](Split split) {
    return [split](const TorsionRecord& r) { return r.split == split; };
  };
  if (std::ranges::any_of(records, is(Split::train))) return follow_the_marks(records);
  std::vector<TorsionRecord*> open;
  for (TorsionRecord& record : records) {
    if (record.split == Split::unassigned) open.push_back(&record);
  }
  std::ranges::stable_sort(open, [](const TorsionRecord* a, const TorsionRecord* b) {
    const double left = motion_range(*a);
    const double right = motion_range(*b);
    return left != right ? left < right : a->id < b->id;
  });
  for (TorsionRecord* record : open) record->split = Split::train;
  const std::vector<std::size_t> held = positions_held_out(open.size());
  for (const std::size_t position : held) open[position]->split = Split::holdout;
  const auto marked = records.size() - open.size();
  if (open.size() < 2 && marked == 0) {
    return "the only recording is trained on; there is none to hold out";
  }
  return fmt::format(
      "no recording is marked for training: {} of {} unmarked ones held out by the automatic "
      "rule{}",
      held.size(), open.size(), marked > 0 ? fmt::format(", {} marked as hold-out", marked) : "");
}

}  // namespace flexspline::studies
