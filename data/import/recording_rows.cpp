#include "import/recording_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flexspline/data/rig_channels.hpp"
#include "import/short_names.hpp"

namespace flexspline::data {
namespace {

constexpr double kRest = 0.005;     // of the motion's range
constexpr double kFarZero = 100.0;  // times the recording's length
constexpr std::size_t kFewestRows = 16;
constexpr std::size_t kLargestGroup = 100000;

bool equal_rows(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(
      a, b, [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

std::optional<std::size_t> motion_of(const FoundTable& table) {
  using enum Quantity;
  for (const Quantity quantity : {motor_angle, torsion, displacement, angle, load_angle}) {
    const auto found = std::ranges::find(table.channels, quantity, &FoundChannel::quantity);
    if (found == table.channels.end()) continue;
    return static_cast<std::size_t>(found - table.channels.begin());
  }
  return std::nullopt;
}

}  // namespace

RecordingRows::RecordingRows(const FoundTable& table, const ImportParts& parts,
                             std::optional<double> split_s, std::filesystem::path folder)
    : table_(table), parts_(parts), folder_(std::move(folder)) {
  const FoundChannel& time = table.channels.front();
  const ColumnSurvey& clock = table.survey.columns[time.column];
  usual_step_ = usual_step(table.survey, time.column);
  const bool far = std::abs(clock.low) > kFarZero * (clock.high - clock.low);
  zero_ = clock.column.epoch_s || far ? std::floor(clock.first) : 0.0;
  if (split_s) split_ = *split_s / time.unit.factor;
  for (std::size_t i = 0; i < table.channels.size(); ++i) {
    const FoundChannel& from = table.channels[i];
    const FoundChannel& to = parts.channels[i];
    same_unit_.push_back(from.unit.symbol == to.unit.symbol &&
                         from.counts_per_rev == to.counts_per_rev);
    names_.emplace_back(short_name(from.quantity));
  }
  if (parts.marks_absent && std::ranges::find(names_, "valid") == names_.end()) {
    names_.emplace_back("valid");
  }
  motion_ = motion_of(table);
  if (motion_) {
    const ColumnSurvey& moved = table.survey.columns[table.channels[*motion_].column];
    still_ = kRest * (moved.high - moved.low);
  }
}

void RecordingRows::fail(Error error) {
  if (!error_) error_ = std::move(error);
}

void RecordingRows::add(const std::vector<double>& row) {
  ++read_;
  if (error_) return;
  if (!std::isfinite(row[0])) {
    ++timeless_;
    return;
  }
  if (!group_.empty() && row[0] == group_.back()[0]) {
    if (equal_rows(row, group_.back())) {
      ++repeated_;
    } else if (group_.size() >= kLargestGroup) {
      fail({ErrorCode::bad_data,
            fmt::format("{}: more than {} rows have the time {}", table_.survey.words(),
                        kLargestGroup, row[0]),
            "state another column as the time: --map t=colN:s",
            {}});
    } else {
      group_.push_back(row);
    }
    return;
  }
  if (!group_.empty()) {
    const double step = row[0] - group_.front()[0];
    spread(step > 0.0 ? std::min(step, 1.5 * usual_step_) : usual_step_);
    take_group();
  }
  group_.assign(1, row);
}

/// Stamps of a clock that is coarser than the samples.
void RecordingRows::spread(double step) {
  if (group_.size() < 2) return;
  spread_ += group_.size();
  const auto count = static_cast<double>(group_.size());
  for (std::size_t i = 1; i < group_.size(); ++i) {
    group_[i][0] += step * static_cast<double>(i) / count;
  }
}

void RecordingRows::take_group() {
  for (const auto& row : group_) place(row);
  group_.clear();
}

void RecordingRows::place(const std::vector<double>& row) {
  if (error_) return;
  const bool falls = last_ && row[0] <= *last_;
  if (falls && !split_) {
    fail({ErrorCode::bad_data,
          fmt::format("{}: time falls from {} to {} {} about row {}", table_.survey.words(), *last_,
                      row[0], table_.channels[0].unit.symbol, read_),
          "cut the recording there: --split SECONDS; or sort the rows",
          {}});
    return;
  }
  if (split_ && last_ && (falls || row[0] - *last_ >= *split_)) end_recording();
  const bool kept_back = split_ && motion_ && rests(row);
  last_ = row[0];
  if (kept_back) {
    resting_.push_back(row);
    ++rested_;
    while (resting_long_ && row[0] - resting_.front()[0] > 0.5 * *split_) resting_.pop_front();
  } else {
    write(row);
  }
}

/// Whether the row belongs to a rest that lasts for half of split_s: it is kept back until it is
/// clear what it is of. After the whole of split_s one recording ends; the last half of the rest
/// begins the next.
bool RecordingRows::rests(const std::vector<double>& row) {
  const double value = row[*motion_];
  const bool moves = !last_ || !(std::abs(value - rest_value_) <= still_);
  if (!moves) {
    resting_long_ = resting_long_ || row[0] - rest_since_ >= *split_;
    return row[0] - rest_since_ >= 0.5 * *split_;
  }
  if (resting_long_) close();
  release();
  rest_value_ = value;
  rest_since_ = row[0];
  return false;
}

/// Rows that were kept back are of the recording at hand.
void RecordingRows::release() {
  rested_ -= resting_.size();
  for (const auto& kept : resting_) write(kept);
  resting_.clear();
  resting_long_ = false;
}

void RecordingRows::end_recording() {
  if (resting_long_) {
    resting_.clear();
    resting_long_ = false;
  }
  release();
  close();
  last_.reset();
}

void RecordingRows::write(const std::vector<double>& row) {
  if (!writer_) {
    const std::string id =
        split_ ? fmt::format("{}-{}", table_.id, recordings_.size() + 1) : table_.id;
    const double start = row[0] * table_.channels[0].unit.factor;
    recordings_.push_back({id, id + ".csv", start, 0});
    auto opened = RowWriter::open(folder_ / recordings_.back().file, names_);
    if (!opened) return fail(opened.error());
    writer_ = std::move(*opened);
  }
  std::vector<double> written(row);
  written[0] -= zero_;
  bool whole = true;
  for (std::size_t i = 0; i < written.size(); ++i) {
    if (!same_unit_[i]) {
      written[i] = from_si(parts_.channels[i].unit, to_si(table_.channels[i].unit, written[i]));
    }
    whole = whole && std::isfinite(written[i]);
  }
  if (names_.size() > written.size()) {
    written.push_back(whole ? 1.0 : 0.0);
  } else if (!whole) {
    const auto mark = std::ranges::find(names_, "valid");
    if (mark != names_.end()) written[static_cast<std::size_t>(mark - names_.begin())] = 0.0;
  }
  writer_->add(written);
}

void RecordingRows::close() {
  if (!writer_) return;
  recordings_.back().rows = writer_->rows();
  if (writer_->rows() < kFewestRows) {
    ++short_;
    recordings_.pop_back();
  } else if (auto done = writer_->finish(); !done) {
    fail(done.error());
  }
  writer_.reset();
}

Result<void> RecordingRows::finish() {
  spread(usual_step_);
  take_group();
  end_recording();
  if (error_) return tl::unexpected(*error_);
  return {};
}

std::vector<std::string> RecordingRows::notes() const {
  std::vector<std::string> list;
  const auto say = [&](std::size_t count, const std::string& what) {
    if (count > 0) list.push_back(fmt::format("{}: {} {}", table_.survey.words(), count, what));
  };
  say(timeless_, "rows without a time are left out");
  say(repeated_, "rows that repeat the one before are left out");
  say(spread_,
      "samples share the time of another: the clock is coarser than the samples, and they "
      "are spread evenly between its stamps");
  say(rested_, "rows in which nothing moves are left out");
  say(short_, "pieces of fewer than 16 rows are left out");
  if (zero_ != 0.0) {
    list.push_back(fmt::format("{}: time is counted from {} {} of the file's clock",
                               table_.survey.words(), zero_, table_.channels[0].unit.symbol));
  }
  return list;
}

}  // namespace flexspline::data
