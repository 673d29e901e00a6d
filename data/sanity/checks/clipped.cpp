#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <Eigen/Dense>

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
constexpr double kTurns = 0.25;  // of what it changes by there: a parabola's middle half does half
constexpr std::size_t kFlank = 8;     // samples beside a row that tell speed and deceleration
constexpr double kNear = 0.1;         // of the range: further out no parabola tells how it comes
constexpr double kTurnsWithin = 0.5;  // of the row: the time in which what was cut off turns
constexpr double kHidden = 2.0;       // levels: what was cut off is more than rounding

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

/// A motion beside a row at its extreme, by least squares: k samples away it has gone
/// c + v k + a k^2/2, v in the direction of the extreme.
struct Flank {
  double speed = 0.0;
  double deceleration = 0.0;
};

Flank flank_of(const std::vector<double>& gone) {
  const auto n = static_cast<Eigen::Index>(gone.size());
  const Eigen::ArrayXd k = Eigen::ArrayXd::LinSpaced(n, 0.5, static_cast<double>(n) - 0.5);
  Eigen::MatrixXd columns(n, 3);
  columns << Eigen::VectorXd::Ones(n), k.matrix(), (0.5 * k.square()).matrix();
  const Eigen::VectorXd b =
      columns.colPivHouseholderQr().solve(Eigen::Map<const Eigen::VectorXd>(gone.data(), n));
  return {b[1], b[2]};
}

/// Whether a row of n samples hides a turn: a motion that comes to an extreme at speed v and is
/// slowed down by a turns 2 v/a samples later, v n/4 beyond what is seen. A motion that stops
/// there, as a motor that sticks does, comes with none.
bool hides_a_turn(const Flank& flank, double row, double level) {
  if (!(flank.speed > 0.0) || flank.speed * row / 4.0 < kHidden * level) return false;
  return 2.0 * flank.speed >= kTurnsWithin * row * flank.deceleration;
}

/// Least distance between two of the levels next to the extreme.
double level_beside(const Series& values, double extreme, bool top) {
  std::vector<double> distinct;
  for (const double value : values) distinct.push_back(top ? extreme - value : value - extreme);
  std::ranges::sort(distinct);
  distinct.erase(std::ranges::unique(distinct).begin(), distinct.end());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < std::min(distinct.size(), kLevels); ++i) {
    least = std::min(least, distinct[i] - distinct[i - 1]);
  }
  return least;
}

/// How far from the extreme the samples are from one of them on, one way, until another is at it or
/// one is too far away.
std::vector<double> gone_from(const Series& values, double extreme, std::ptrdiff_t from,
                              std::ptrdiff_t way, std::size_t most) {
  const double far = kNear * range_of(values);
  std::vector<double> gone;
  const auto size = static_cast<std::ptrdiff_t>(values.size());
  for (std::ptrdiff_t i = from; i >= 0 && i < size && gone.size() < most; i += way) {
    const double value = values[static_cast<std::size_t>(i)];
    if (value == extreme) break;
    if (gone.size() >= kFlank && std::abs(extreme - value) > far) break;
    gone.push_back(std::abs(extreme - value));
  }
  return gone;
}

/// Whether most of the rows at an extreme are come to, and left, by a motion that goes on beyond.
bool goes_on_beyond(const Series& values, double extreme, bool top) {
  const double level = level_beside(values, extreme, top);
  std::size_t flanks = 0;
  std::size_t hiding = 0;
  for (std::size_t first = 0, last = 0; first < values.size(); first = last + 1) {
    last = first;
    while (last < values.size() && values[last] == extreme) ++last;
    const std::size_t row = last - first;
    if (row < kLeastRow) continue;
    const std::size_t most = std::max(kFlank, row);
    for (const auto& gone :
         {gone_from(values, extreme, static_cast<std::ptrdiff_t>(first) - 1, -1, most),
          gone_from(values, extreme, static_cast<std::ptrdiff_t>(last), 1, most)}) {
      if (gone.size() < kFlank) continue;
      ++flanks;
      hiding += hides_a_turn(flank_of(gone), static_cast<double>(row), level) ? 1 : 0;
    }
  }
  return 2 * hiding > flanks;
}

/// Whether the torque of a gear is further out in the middle of a row than at its ends, by part
/// of what it changes by in it: it turns where its angle is cut off, and falls back where that
/// rests.
bool turns_in(const Series& torque, const AtExtreme& extreme) {
  const Eigen::Map<const Eigen::ArrayXd> all(torque.data(),
                                             static_cast<Eigen::Index>(torque.size()));
  const auto row = static_cast<Eigen::Index>(extreme.row);
  const Eigen::ArrayXd part = all.segment(static_cast<Eigen::Index>(extreme.first), row);
  const double out = part.mean() > all.mean() ? 1.0 : -1.0;
  const Eigen::Index quarter = row / 4;
  const double ends = 0.5 * (part.head(quarter).mean() + part.tail(quarter).mean());
  const double middle = part.segment(quarter, row - 2 * quarter).mean();
  return out * (middle - ends) > kTurns * (part.maxCoeff() - part.minCoeff());
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
  if (is_position(quantity) && extreme.rows < 2) return false;  // what is parked stands once
  const auto beside = static_cast<double>(at_levels_beside(values, extreme.value, top));
  if (static_cast<double>(extreme.count) < kAgainstLevels * beside) return false;
  if (is_position(quantity) && !goes_on_beyond(values, extreme.value, top)) return false;
  // Of a locked drive the motor's torque moves while it sticks, too, and the gear's follows its
  // angle.
  const Series* torque = recording.find(Quantity::transmitted_torque);
  if (all.set.rig == Rig::locked && quantity == Quantity::motor_angle && torque != nullptr) {
    return turns_in(*torque, extreme);
  }
  return partner_moves(all, recording, quantity, extreme) > kPartnerMoves;
}

std::vector<SanityFinding> find(const ObservedSet& all) {
  std::vector<SanityFinding> list;
  for (const Recording& whole : all.set.recordings) {
    const Recording recording = without_marked(whole);
    for (const Quantity quantity : sensed_channels(all.set)) {
      const Series* values = recording.find(quantity);
      if (values == nullptr || values->empty() || !(range_of(*values) > 0.0)) continue;
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
