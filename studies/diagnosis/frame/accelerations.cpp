#include "diagnosis/frame/accelerations.hpp"

#include <algorithm>
#include <utility>

#include "diagnosis/frame/shared_baseline.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Series = std::vector<double>;

// A spline of bandwidth b forgets an end by exp(-b t/2): after 4/b a seventh of it is left.
constexpr double kEnd = 4.0;
constexpr double kLeastHeld = 0.5;  // of a recording

constexpr std::array kAll = {&Accelerations::motor,       &Accelerations::load,
                             &Accelerations::motor_error, &Accelerations::load_error,
                             &Accelerations::bandwidth,   &Accelerations::held};

Accelerations of_rows(Index rows) {
  Accelerations all;
  for (ArrayXd Accelerations::*one : kAll) (all.*one).setZero(rows);
  return all;
}

// Every stride-th sample.
struct Thinned {
  Index count, stride;

  ArrayXd operator()(const Series& from) const {
    if (from.empty()) return ArrayXd::Zero(count);
    return ArrayXd::NullaryExpr(
        count, [&](Index i) { return from[static_cast<std::size_t>(i * stride)]; });
  }
};

Accelerations own_of(const DriveChannels& c, const Thinned& thinned) {
  const ArrayXd ones = ArrayXd::Ones(thinned.count);
  return {thinned(c.motor_acceleration),
          thinned(c.load_acceleration),
          thinned(c.motor_acceleration_error),
          thinned(c.load_acceleration_error),
          c.motor_bandwidth * ones,
          ones};
}

Accelerations narrower_of(const DriveChannels::Narrower& c, const ArrayXd& time,
                          const Thinned& thinned) {
  const double end = kEnd / std::min(c.motor_bandwidth, c.load_bandwidth);
  const ArrayXd from_end = (time - time[0]).min(time[time.size() - 1] - time);
  return {thinned(c.motor),
          thinned(c.load),
          thinned(c.motor_error),
          thinned(c.load_error),
          ArrayXd::Constant(thinned.count, c.motor_bandwidth),
          (from_end >= end).cast<double>()};
}

}  // namespace

void AccelerationsMaker::add(const DriveChannels& channels, Index first, Index count,
                             Index stride) {
  if (channels.narrower.empty()) return;
  if (list_.empty()) list_.assign(1 + channels.narrower.size(), of_rows(rows_));
  const Thinned thinned{count, stride};
  const ArrayXd time = thinned(channels.time);
  Accelerations last = own_of(channels, thinned);
  for (std::size_t k = 0; k < list_.size(); ++k) {
    if (k > 0) {
      Accelerations next = narrower_of(channels.narrower[k - 1], time, thinned);
      if (next.held.mean() >= kLeastHeld) last = std::move(next);
    }
    for (ArrayXd Accelerations::*one : kAll) {
      (list_[k].*one).segment(first, count) = last.*one;
    }
  }
}

void AccelerationsMaker::give(Frame& frame) {
  if (list_.empty()) return;
  frame.accelerations_held = list_.front().held;
  frame.accelerations = std::make_shared<const std::vector<Accelerations>>(std::move(list_));
}

Frame with_bandwidths(Frame f, const std::vector<std::size_t>& bandwidths) {
  for (std::size_t i = 0; i < f.segments.size(); ++i) {
    Segment& s = f.segments[i];
    if (s.bandwidth == bandwidths[i]) continue;
    s.bandwidth = bandwidths[i];
    const Accelerations& from = (*f.accelerations)[s.bandwidth];
    const auto take = [&](ArrayXd& to, const ArrayXd& all) {
      to.segment(s.first, s.count) = all.segment(s.first, s.count);
    };
    take(f.motor_acceleration, from.motor), take(f.load_acceleration, from.load);
    take(f.motor_acceleration_error, from.motor_error);
    take(f.load_acceleration_error, from.load_error);
    take(f.motor_bandwidth, from.bandwidth), take(f.accelerations_held, from.held);
  }
  if (f.rig == Rig::servo) f.hang_pendulum();
  f.weigh_load();
  if (f.rig != Rig::free) {  // whose torsion is smoothed as it is
    f.torsion_acceleration = f.motor_acceleration / f.ratio - f.load_acceleration;
  }
  f.torque_range = (f.torque.abs() * f.usable).maxCoeff();
  if (f.kept) f.kept = no_baselines_yet();
  return f;
}

}  // namespace flexspline::studies
