#include "import/joined_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "import/join_tables.hpp"

namespace flexspline::data {
namespace {

bool is_mark(Quantity quantity) {
  return quantity == Quantity::valid || quantity == Quantity::drive_enabled;
}

}  // namespace

JoinedRows::JoinedRows(const FoundTable& table, const TableLimits& limits, RecordingRows& rows)
    : table_(table), most_values_(limits.memory_bytes / sizeof(double)), rows_(rows) {
  for (const TablePart& part : table.survey.parts)
    parts_.push_back({&part, {part.clock}, 0, {}, 0});
  place_channels();
}

/// Where each channel lies, and with it the columns that are wanted of each part.
void JoinedRows::place_channels() {
  std::vector<std::pair<std::size_t, std::size_t>> columns;  // part and column of each joined one
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    for (const std::size_t column : parts_[p].of->columns) columns.emplace_back(p, column);
  }
  for (const FoundChannel& one : table_.channels) {
    const auto [part, column] = columns[one.column];
    parts_[part].wanted.push_back(column);
  }
  for (Part& part : parts_) {
    std::ranges::sort(part.wanted);
    const auto [from, to] = std::ranges::unique(part.wanted);
    part.wanted.erase(from, to);
    part.values.resize(part.wanted.size());
  }
  const auto value_of = [](const Part& part, std::size_t column) {
    return static_cast<std::size_t>(std::ranges::find(part.wanted, column) - part.wanted.begin());
  };
  for (Part& part : parts_) part.clock = value_of(part, part.of->clock);
  for (const FoundChannel& one : table_.channels) {
    const auto [part, column] = columns[one.column];
    places_.push_back({part, value_of(parts_[part], column), is_mark(one.quantity)});
  }
}

std::vector<std::size_t> JoinedRows::begin(const TableHead&) {
  const std::size_t index = index_++;
  const auto found =
      std::ranges::find_if(parts_, [&](const Part& one) { return one.of->index == index; });
  at_hand_ = found == parts_.end() ? nullptr : &*found;
  return at_hand_ != nullptr ? at_hand_->wanted : std::vector<std::size_t>{};
}

void JoinedRows::rows(std::span<const std::vector<double>> columns) {
  values_ += columns.size() * columns[0].size();
  if (values_ > most_values_) return;
  for (std::size_t i = 0; i < columns[0].size(); ++i) {
    const double time = columns[at_hand_->clock][i];
    if (!std::isfinite(time)) continue;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      at_hand_->values[c].push_back(c == at_hand_->clock ? at_hand_->of->clock_factor * time +
                                                               at_hand_->of->clock_offset
                                                         : columns[c][i]);
    }
  }
}

Result<void> JoinedRows::check_clocks() {
  if (values_ > most_values_) {
    return failure(ErrorCode::bad_data,
                   fmt::format("{}: joining its tables takes more memory than {} MiB",
                               table_.survey.words(), most_values_ * sizeof(double) >> 20U),
                   "export it on one clock, or in shorter pieces");
  }
  for (const Part& part : parts_) {
    const auto& clock = part.values[part.clock];
    if (std::ranges::adjacent_find(clock, std::greater_equal()) == clock.end()) continue;
    return failure(ErrorCode::bad_data, table_.survey.words() + ": a time falls or repeats",
                   "export it on one clock");
  }
  return {};
}

/// False where some part has no value.
bool JoinedRows::take_row(std::size_t row, std::vector<double>& to) {
  const double at = parts_[0].values[parts_[0].clock][row];
  for (Part& part : parts_) {
    const auto& clock = part.values[part.clock];
    while (part.next < clock.size() && !(clock[part.next] > at)) ++part.next;
  }
  bool exact = true;
  for (std::size_t c = 0; c < places_.size(); ++c) {
    const Part& part = parts_[places_[c].part];
    const auto& clock = part.values[part.clock];
    const auto& values = part.values[places_[c].value];
    if (places_[c].part == 0) {
      to[c] = values[row];
      continue;
    }
    const Between found = value_between(clock, clock, part.next, at, part.of->longest_step);
    if (!std::isfinite(found.value)) return false;
    const Between value = value_between(clock, values, part.next, at, part.of->longest_step);
    exact = exact && value.exact;
    to[c] = places_[c].mark && !value.exact ? std::min(values[part.next - 1], values[part.next])
                                            : value.value;
  }
  between_ += exact ? 0 : 1;
  return true;
}

Result<void> JoinedRows::join() {
  if (auto sound = check_clocks(); !sound) return sound;
  std::vector<double> row(places_.size());
  for (std::size_t i = 0; i < parts_[0].values[parts_[0].clock].size(); ++i) {
    if (take_row(i, row)) {
      rows_.add(row);
      ++written_;
    } else {
      ++alone_;
    }
  }
  return {};
}

std::vector<std::string> JoinedRows::notes() const {
  std::vector<std::string> list;
  const auto say = [&](std::size_t count, const std::string& what) {
    if (count > 0) list.push_back(fmt::format("{}: {} {}", table_.survey.words(), count, what));
  };
  say(between_,
      fmt::format("of {} rows lie between samples of the other tables, whose values are taken "
                  "linearly between the two around",
                  written_));
  say(alone_, "rows of the slowest are left out: another table has no sample there");
  return list;
}

}  // namespace flexspline::data
