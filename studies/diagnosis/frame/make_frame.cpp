#include "diagnosis/frame/frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "diagnosis/frame/accelerations.hpp"
#include "diagnosis/frame/baseline.hpp"
#include "diagnosis/frame/counted.hpp"
#include "diagnosis/frame/equations_of.hpp"
#include "diagnosis/frame/middle.hpp"
#include "diagnosis/frame/periodic_angle.hpp"
#include "diagnosis/frame/rate_of.hpp"
#include "diagnosis/frame/repeats.hpp"
#include "diagnosis/frame/shared_baseline.hpp"
#include "diagnosis/frame/smoothed.hpp"
#include "diagnosis/frame/sticking.hpp"
#include "flexspline/core/estimate.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Series = std::vector<double>;

constexpr double kRippleError = 0.02;   // of the acceleration that follows from a periodic angle
constexpr double kRippleLimit = 0.002;  // that error's torque over the largest motor torque
constexpr double kSameZero = 0.2;       // zeros that differ by less, over the widest motion
constexpr double kFarZero = 0.25;       // of half the motion: a tenth of torque as offset is nearer
constexpr double kForgotten = 5.0;      // time constants, after which 0.7 % of a start are left
constexpr double kBeginning = 0.2;      // of a recording, at most that much of it is a start
constexpr Index kEndRows = 4;           // a smoothing spline's derivatives are loose at its ends

double constant(const RecordingSet& set, const std::string& key, double fallback) {
  const auto found = set.constants.find(key);
  return found == set.constants.end() ? fallback : found->second;
}

/// The smooth channels of one recording before thinning.
struct Channels {
  const Recording* recording = nullptr;
  DriveChannels drive;
  Series torque_rate, smooth_torque, motor_torque_rate, smooth_motor_torque;
};

// Smooth copy and rate of a torque, by the smoothing that motions get.
void smooth_torque(const Recording& recording, const Series& torque, Resolution resolution,
                   Series& smooth, Series& rate) {
  const auto channels = smoothed(recording, torque, resolution);
  if (!channels) return;
  smooth = channels->torsion;
  rate = channels->torsion_rate;
}

Result<Channels> channels_of(const RecordingSet& set, const Recording& recording,
                             const PeriodicAngle& periodic) {
  auto drive = channels_with(set, recording, periodic);
  if (!drive) return tl::unexpected(drive.error());
  Channels c{&recording, std::move(*drive), {}, {}, {}, {}};
  if (!c.drive.transmitted_torque.empty()) {
    smooth_torque(recording, c.drive.transmitted_torque, resolution_on(set.rig), c.smooth_torque,
                  c.torque_rate);
  }
  if (!c.drive.motor_torque.empty()) {
    smooth_torque(recording, c.drive.motor_torque, resolution_on(set.rig), c.smooth_motor_torque,
                  c.motor_torque_rate);
  }
  return c;
}

// Earlier first; where the clock does not tell, by what was recorded.
bool comes_before(const Recording* a, const Recording* b) {
  if (a->start_s != b->start_s) return a->start_s < b->start_s;
  if (a->time.size() != b->time.size()) return a->time.size() < b->time.size();
  return a->channels < b->channels;
}

std::vector<const Recording*> in_order(const RecordingSet& set) {
  std::vector<const Recording*> order;
  for (const Recording& recording : set.recordings) order.push_back(&recording);
  std::ranges::sort(order, comes_before);
  return order;
}

void append(ArrayXd& to, Index first, Index count, const Series& from, Index stride) {
  for (Index i = 0; i < count; ++i) {
    to[first + i] = from.empty() ? 0.0 : from[static_cast<std::size_t>(i * stride)];
  }
}

class FrameMaker {
 public:
  FrameMaker(const RecordingSet& set, const PeriodicAngle& periodic, Index rows)
      : set_(set), periodic_(periodic), accelerations_(rows) {
    frame_.rig = set.rig;
    frame_.kept = no_baselines_yet();
    frame_.ratio = constant(set, "gear_ratio", 1.0);
    frame_.motor_inertia = constant(set, "motor_inertia_kgm2", 0.0);
    frame_.load_inertia = constant(set, "load_inertia_kgm2", 0.0);
    frame_.torque_by_inertia = has_torque_by_inertia(set);
    frame_.load_mass = constant(set, "load_mass_kg", 0.0);
    frame_.arm_length = constant(set, "arm_length_m", 0.0);
    for (ArrayXd* channel : all()) channel->setZero(rows);
  }

  void add(const Channels& c, Index stride) {
    const Index n = static_cast<Index>(c.recording->time.size());
    const Index count = (n + stride - 1) / stride;
    const DriveChannels& d = c.drive;
    for (Quantity one : {Quantity::motor_torque, Quantity::current, Quantity::duty_cycle}) {
      if (c.recording->find(one) == nullptr) continue;
      frame_.drives = one;
      break;
    }
    const auto put = [&](ArrayXd& to, const Series& from) { append(to, at_, count, from, stride); };
    put(frame_.time, d.time);
    frame_.clock.segment(at_, count) =
        frame_.time.segment(at_, count) - frame_.time[at_] + c.recording->start_s;
    put(frame_.motor_angle, d.motor_angle), put(frame_.motor_speed, d.motor_speed);
    put(frame_.motor_acceleration, d.motor_acceleration);
    frame_.motor_bandwidth.segment(at_, count) = d.motor_bandwidth;
    put(frame_.load_angle, d.load_angle), put(frame_.load_speed, d.load_speed);
    put(frame_.load_acceleration, d.load_acceleration);
    put(frame_.torsion, d.torsion), put(frame_.torsion_rate, d.torsion_rate);
    put(frame_.torsion_acceleration, d.torsion_acceleration);
    put(frame_.motor_speed_error, d.motor_speed_error);
    put(frame_.torsion_error, torsion_error(*c.recording, frame_.rig, frame_.ratio, d));
    put(frame_.torsion_rate_error, d.torsion_rate_error);
    put(frame_.motor_acceleration_error, d.motor_acceleration_error);
    put(frame_.load_acceleration_error, d.load_acceleration_error);
    put(frame_.torque, d.transmitted_torque), put(frame_.smooth_torque, c.smooth_torque);
    put(frame_.torque_rate, c.torque_rate), put(frame_.motor_torque, d.motor_torque);
    put(frame_.smooth_motor_torque, c.smooth_motor_torque);
    put(frame_.motor_torque_rate, c.motor_torque_rate);
    if (const Series* velocity = c.recording->find(Quantity::velocity)) {
      put(frame_.velocity, *velocity);
    } else {
      frame_.velocity.segment(at_, count) = kNotComputed;
    }
    mark_usable(*c.recording, count, stride);
    put(frame_.motor_slides, counted_motor(*c.recording, d.motor_bandwidth));
    accelerations_.add(d, at_, count, stride);
    frame_.segments.push_back({c.recording->id, at_, count, c.recording->split});
    at_ += count;
  }

  Frame finish() {
    complete_motion();
    centre_recordings();
    centre_together();
    measure_ranges();
    frame_.periodic_rate = periodic_.rate(frame_.motor_angle, frame_.motor_speed) / frame_.ratio;
    frame_.motor_slides *= motor_slides(frame_);
    leave_out_starts();
    leave_out_hidden_motor();
    if (frame_.rig == Rig::locked || frame_.rig == Rig::free)
      frame_.told_torque = told_torque(frame_);
    if (frame_.torque_by_inertia) {
      frame_.smooth_torque = frame_.told_torque;
      frame_.torque_rate = rate_of(frame_, frame_.told_torque);
    }
    for (Segment& s : frame_.segments) {
      s.repeat = repeat_of(frame_.motor_angle.segment(s.first, s.count));
    }
    accelerations_.give(frame_);
    return std::move(frame_);
  }

 private:
  std::vector<ArrayXd*> all() {
    Frame& f = frame_;
    return {&f.time,
            &f.clock,
            &f.motor_angle,
            &f.motor_speed,
            &f.motor_acceleration,
            &f.motor_bandwidth,
            &f.load_angle,
            &f.load_speed,
            &f.load_acceleration,
            &f.torsion,
            &f.torsion_rate,
            &f.torsion_acceleration,
            &f.motor_speed_error,
            &f.motor_acceleration_error,
            &f.load_acceleration_error,
            &f.torsion_error,
            &f.torsion_rate_error,
            &f.torque,
            &f.smooth_torque,
            &f.torque_rate,
            &f.motor_torque,
            &f.smooth_motor_torque,
            &f.motor_torque_rate,
            &f.velocity,
            &f.usable,
            &f.motor_slides};
  }

  void mark_usable(const Recording& recording, Index count, Index stride) {
    const Series* valid = recording.find(Quantity::valid);
    const Series* enabled = recording.find(Quantity::drive_enabled);
    for (Index i = 0; i < count; ++i) {
      const auto k = static_cast<std::size_t>(i * stride);
      const bool good =
          (valid == nullptr || (*valid)[k] > 0.5) && (enabled == nullptr || (*enabled)[k] > 0.5);
      frame_.usable[at_ + i] = good && i >= kEndRows && i + kEndRows < count ? 1.0 : 0.0;
    }
  }

  // On a specimen one motion stands for all; on the others the torsion follows from the angles.
  void complete_motion() {
    Frame& f = frame_;
    if (f.rig == Rig::specimen) {
      const double turns = f.travels ? f.ratio : 1.0;
      f.motor_angle = turns * f.torsion, f.motor_speed = turns * f.torsion_rate;
      f.motor_acceleration = turns * f.torsion_acceleration;
      f.load_angle = f.torsion, f.load_speed = f.torsion_rate;
      f.load_acceleration = f.torsion_acceleration;
      return;
    }
    f.weigh_load();
    if (f.rig == Rig::free) return;  // smoothed as it is
    if (f.rig == Rig::servo) f.hang_pendulum();
    f.torsion = f.motor_angle / f.ratio - f.load_angle;
    f.torsion_rate = f.motor_speed / f.ratio - f.load_speed;
    f.torsion_rate_error = f.motor_speed_error / f.ratio;
    f.torsion_acceleration = f.motor_acceleration / f.ratio - f.load_acceleration;
  }

  // Where the zero of all lies too far out for a fit to start from none.
  void centre_together() {
    Frame& f = frame_;
    if (f.travels || f.own_zeros || f.rig == Rig::servo || (f.torque == 0.0).all()) return;
    Series zeros;
    for (const Segment& s : f.segments) {
      if (const double zero = unloaded_at(s).at; zero != 0.0) zeros.push_back(zero);
    }
    if (zeros.empty()) return;
    const double zero = middle(zeros);
    const double reach = 0.5 * (f.torsion.maxCoeff() - f.torsion.minCoeff());
    if (std::abs(zero) < kFarZero * reach) return;
    f.torsion -= zero;
    if (f.rig == Rig::specimen) f.load_angle = f.motor_angle = f.torsion;
    f.zero = zero;
    f.notes.push_back(
        fmt::format("the zero of the torsion has an error of {:.0f} % of half its range: it is "
                    "counted from where the "
                    "torque changes its sign",
                    100.0 * std::abs(zero) / reach));
  }

  /// Mean torsion where the torque changes its sign; 0 where it does so less than four times.
  struct Unloaded {
    double at = 0.0;
    double of_ways = 0.0;  ///< mean of those where it rises and where it falls: friction parts them
  };

  Unloaded unloaded_at(const Segment& s) const {
    std::array<double, 2> sum = {0.0, 0.0};
    std::array<int, 2> count = {0, 0};
    for (Index r = s.first + 1; r < s.first + s.count; ++r) {
      if (frame_.torque[r] * frame_.torque[r - 1] > 0.0) continue;
      const std::size_t way = frame_.torque[r] > frame_.torque[r - 1] ? 1 : 0;
      sum[way] += 0.5 * (frame_.torsion[r] + frame_.torsion[r - 1]);
      ++count[way];
    }
    if (count[0] + count[1] < 4 || std::min(count[0], count[1]) == 0) return {};
    return {(sum[0] + sum[1]) / (count[0] + count[1]),
            0.5 * (sum[0] / count[0] + sum[1] / count[1])};
  }

  // Mountings whose zeros differ are each counted from where they are unloaded.
  void centre_recordings() {
    Frame& f = frame_;
    if (f.rig != Rig::specimen || f.travels) return;
    ArrayXd zeros(static_cast<Index>(f.segments.size()));
    double widest = 0.0, furthest = 0.0;
    for (Index i = 0; i < zeros.size(); ++i) {
      const Segment& s = f.segments[static_cast<std::size_t>(i)];
      const auto [at, of_ways] = unloaded_at(s);
      zeros[i] = at;
      furthest = std::max(furthest, std::min(std::abs(at), std::abs(of_ways)));
      const auto part = f.torsion.segment(s.first, s.count);
      widest = std::max(widest, 0.5 * (part.maxCoeff() - part.minCoeff()));
    }
    if (furthest < kSameZero * widest) return;
    for (Index i = 0; i < zeros.size(); ++i) {
      Segment& s = f.segments[static_cast<std::size_t>(i)];
      f.torsion.segment(s.first, s.count) -= zeros[i];
      s.zero = zeros[i];
    }
    f.load_angle = f.motor_angle = f.torsion;
    f.own_zeros = true;
    f.notes.emplace_back(
        "the zeros of the recordings differ: each is counted from where the model fits it best, "
        "one "
        "number a recording; one that a search did not have, from where it is unloaded");
  }

  // What a joint did before its recording began still moves the torque behind a filter or a delay.
  void leave_out_starts() {
    Frame& f = frame_;
    if (!f.travels) return;
    const double forgotten = kForgotten * f.longest_lag();
    if (!std::isfinite(forgotten)) return;
    for (const Segment& s : f.segments) {
      const ArrayXd time = f.time.segment(s.first, s.count) - f.time[s.first];
      const double start = std::min(forgotten, kBeginning * time[s.count - 1]);
      f.usable.segment(s.first, s.count) *= (time >= start).cast<double>();
    }
  }

  // A motor that follows a kinematic error accelerates by more than its angle can tell.
  void leave_out_hidden_motor() {
    Frame& f = frame_;
    if (periodic_.terms.empty() || !f.has(Equation::motor)) return;
    const ArrayXd bent = f.motor_angle.unaryExpr([&](double x) { return periodic_.curvature(x); });
    const double torque =
        f.motor_inertia * std::sqrt((bent * f.motor_speed.square()).square().mean());
    if (kRippleError * torque < kRippleLimit * f.motor_torque.abs().maxCoeff()) return;
    std::erase(f.equations, Equation::motor);
    f.notes.emplace_back(
        "the motor equation is not judged: the motor follows a periodic error of the transmission, "
        "and its acceleration is not known well enough from its angle");
  }

  void measure_ranges() {
    Frame& f = frame_;
    f.measure_torsion();
    f.speed_range = (f.motor_speed.abs() * f.usable).maxCoeff();
    f.torque_range = (f.torque.abs() * f.usable).maxCoeff();
    f.clock -= f.clock.minCoeff();
    f.session = f.clock.maxCoeff();
    Series steps;
    for (const Segment& s : f.segments) {
      f.duration = std::max(f.duration, f.time[s.first + s.count - 1] - f.time[s.first]);
      for (Index i = s.first + 1; i < s.first + s.count; ++i) {
        steps.push_back(f.time[i] - f.time[i - 1]);
      }
    }
    f.interval = percentile(steps, 0.5);
  }

  const RecordingSet& set_;
  const PeriodicAngle& periodic_;
  Frame frame_;
  Index at_ = 0;
  AccelerationsMaker accelerations_;

 public:
  void set_travels(bool travels) { frame_.travels = travels; }
  void set_equations(std::vector<Equation> list) { frame_.equations = std::move(list); }
};

Index stride_for(const std::vector<const Recording*>& order, Index most_rows) {
  Index total = 0;
  for (const Recording* r : order) total += static_cast<Index>(r->time.size());
  return (total + most_rows - 1) / most_rows;
}

}  // namespace

Result<Frame> make_frame(const RecordingSet& set, Index most_rows) {
  if (set.recordings.empty()) {
    return failure(ErrorCode::bad_data, "the data set has no recordings",
                   "a diagnosis needs one or more");
  }
  const auto order = in_order(set);
  const Index stride = stride_for(order, most_rows);
  Index rows = 0;
  for (const Recording* r : order) {
    rows += (static_cast<Index>(r->time.size()) + stride - 1) / stride;
  }
  const PeriodicAngle periodic = periodic_angle(set);
  FrameMaker maker(set, periodic, rows);
  std::vector<Equation> equations;
  for (const Recording* recording : order) {
    const auto channels = channels_of(set, *recording, periodic);
    if (!channels) return tl::unexpected(in_context(channels.error(), recording->id));
    auto allowed = equations_of(set, recording->id, channels->drive);
    if (!allowed) return tl::unexpected(allowed.error());
    equations = *std::move(allowed);
    maker.set_travels(recording->find(Quantity::angle) != nullptr);
    maker.add(*channels, stride);
  }
  maker.set_equations(equations);
  return maker.finish();
}

}  // namespace flexspline::studies
