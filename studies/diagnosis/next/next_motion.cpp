#include "diagnosis/next/next_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "diagnosis/model/cause_columns.hpp"
#include "diagnosis/model/specification.hpp"
#include "flexspline/core/estimate.hpp"
#include "flexspline/core/simulate_rig.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr Index kSamples = 600;
constexpr double kCycles = 3.0;
constexpr double kReach = 1.02;  // of what was recorded
constexpr double kShares[] = {0.1, 0.25, 0.5, 0.75, 1.0};
// Two models are compared along one motion, so that its own error has no say. What asks for more
// steps than these, sixteen a sample, is not proposed: a stiff gap had taken minutes a motion.
constexpr IntegratorSettings kPlanned{1e-4, 1e-4, 16 * kSamples};

double largest(const Frame& f, const ArrayXd& channel) {
  return (channel.abs() * f.usable).maxCoeff();
}

/// A frame with the rig and the ranges of another, of one recording that is still at rest.
Frame empty_like(const Frame& like, Index rows) {
  Frame f = like;
  f.segments = {{"next", 0, rows, Split::train}};
  f.incidents.clear();
  for (ArrayXd* channel :
       {&f.motor_angle, &f.motor_speed, &f.motor_acceleration, &f.load_angle, &f.load_speed,
        &f.load_acceleration, &f.torsion, &f.torsion_rate, &f.torsion_acceleration, &f.torque,
        &f.smooth_torque, &f.told_torque, &f.torque_rate, &f.gravity, &f.motor_torque,
        &f.smooth_motor_torque, &f.motor_torque_rate}) {
    channel->setZero(rows);
  }
  f.motor_bandwidth.resize(0);
  f.motor_acceleration_error.resize(0);
  f.load_acceleration_error.resize(0);
  f.motor_speed_error.resize(0);
  f.torsion_error.resize(0);
  f.torsion_rate_error.resize(0);
  f.periodic_rate.resize(0);
  f.motor_slides.resize(0);
  f.velocity = ArrayXd::Constant(rows, kNotComputed);
  f.usable = ArrayXd::Ones(rows);
  return f;
}

// The torques that the model predicts, for the causes that go by them.
void take_torques(Frame& f, const DriveModel& model) {
  if (f.has(Equation::torsion)) {
    f.torque = evaluate(f, model, reference_of(f, model)).prediction[index_of(Equation::torsion)];
    f.smooth_torque = f.told_torque = f.torque;
    f.torque_rate = rate_of(f, f.torque);
  }
  if (!f.has(Equation::motor)) return;
  f.motor_torque = evaluate(f, model, reference_of(f, model)).prediction[index_of(Equation::motor)];
  f.smooth_motor_torque = f.motor_torque;
  f.motor_torque_rate = rate_of(f, f.motor_torque);
}

/// An angle that is imposed: of the torsion, or of an output that turns.
struct Imposed {
  double centre = 0.0;
  double range = 0.0;  ///< largest amplitude
  double rate = 0.0;   ///< largest rate
  const char* says = "";
};

Imposed imposed_on(const Frame& f) {
  if (f.rig != Rig::servo && !f.travels) return {0.0, f.torsion_range, f.rate_range, "sine"};
  const ArrayXd& angle = f.rig == Rig::servo ? f.load_angle : f.torsion;
  const ArrayXd& rate = f.rig == Rig::servo ? f.load_speed : f.torsion_rate;
  return {0.5 * (angle.maxCoeff() + angle.minCoeff()), 0.5 * (angle.maxCoeff() - angle.minCoeff()),
          largest(f, rate), f.rig == Rig::servo ? "sine of the load's angle" : "sine of the angle"};
}

void turn_with_load(Frame& f) {
  f.motor_angle = f.ratio * f.load_angle, f.motor_speed = f.ratio * f.load_speed;
  f.motor_acceleration = f.ratio * f.load_acceleration;
  f.hang_pendulum();
}

void turn_with_torsion(Frame& f) {
  const double turns = f.rig == Rig::locked || f.travels ? f.ratio : 1.0;
  f.motor_angle = turns * f.torsion, f.motor_speed = turns * f.torsion_rate;
  f.motor_acceleration = turns * f.torsion_acceleration;
  if (f.rig == Rig::locked) return;
  f.load_angle = f.torsion, f.load_speed = f.torsion_rate;
  f.load_acceleration = f.torsion_acceleration;
}

NextMotion imposed_motion(const Frame& like, const DriveModel& model, const Imposed& angle,
                          double amplitude, double frequency) {
  NextMotion next{empty_like(like, kSamples), amplitude, frequency, angle.says};
  Frame& f = next.frame;
  const double w = 2.0 * std::numbers::pi * frequency;
  f.time = ArrayXd::LinSpaced(kSamples, 0.0, kCycles / frequency);
  f.clock = f.time;
  const ArrayXd s = (w * f.time).sin();
  const bool servo = f.rig == Rig::servo;
  (servo ? f.load_angle : f.torsion) = angle.centre + amplitude * s;
  (servo ? f.load_speed : f.torsion_rate) = amplitude * w * (w * f.time).cos();
  (servo ? f.load_acceleration : f.torsion_acceleration) = -amplitude * w * w * s;
  servo ? turn_with_load(f) : turn_with_torsion(f);
  take_torques(f, model);
  return next;
}

std::vector<NextMotion> imposed_motions(const Frame& like, const DriveModel& model) {
  const Imposed angle = imposed_on(like);
  const double fast = angle.rate / (2.0 * std::numbers::pi * angle.range);
  const double slow = std::max(0.3 / like.duration, 1e-4 * fast);
  std::vector<NextMotion> list;
  for (const double share : kShares) {
    for (const double frequency : geometric(slow, 3.0 * fast, 8)) {
      if (share * frequency > kReach * fast) continue;
      list.push_back(imposed_motion(like, model, angle, share * angle.range, frequency));
      const bool drives = like.has(Equation::motor);
      if (drives && largest(list.back().frame, list.back().frame.motor_torque) >
                        kReach * largest(like, like.motor_torque)) {
        list.pop_back();
      }
    }
  }
  return list;
}

/// A set of one recording, driven by A cos(w t) of the motor's torque.
RecordingSet driven_set(const Frame& like, double torque, double frequency) {
  RecordingSet set;
  set.rig = like.rig;
  set.constants = {{"gear_ratio", like.ratio},
                   {"motor_inertia_kgm2", like.motor_inertia},
                   {"load_inertia_kgm2", like.load_inertia}};
  Recording recording;
  recording.id = "next";
  for (Index k = 0; k < kSamples; ++k) {
    const double t = kCycles / frequency * static_cast<double>(k) / (kSamples - 1.0);
    recording.time.push_back(t);
    recording.channels[Quantity::motor_torque].push_back(
        torque * std::cos(2.0 * std::numbers::pi * frequency * t));
  }
  set.recordings.push_back(std::move(recording));
  return set;
}

bool within(const Frame& like, const Frame& next) {
  const auto reaches = [&](ArrayXd Frame::*channel) {
    return largest(next, next.*channel) <= kReach * largest(like, like.*channel);
  };
  return reaches(&Frame::torsion) && reaches(&Frame::torsion_rate) &&
         reaches(&Frame::motor_speed) && reaches(&Frame::load_angle);
}

std::optional<NextMotion> driven_motion(const Frame& like, const RigModel& rig, double torque,
                                        double frequency) {
  RecordingSet set = driven_set(like, torque, frequency);
  Recording& recording = set.recordings.front();
  const auto motion = motions_under(rig, recording, kPlanned);
  if (!motion) return std::nullopt;
  for (const auto& [quantity, channel] : motion->channels) recording.channels[quantity] = channel;
  const auto made = make_frame(set, kSamples);
  if (!made || made->rows() != kSamples) return std::nullopt;
  NextMotion next{*made, 0.0, frequency,
                  fmt::format("sine of the motor's torque, {:.3g} Nm from rest,", torque)};
  Frame& f = next.frame;
  next.amplitude = 0.5 * (f.load_angle.maxCoeff() - f.load_angle.minCoeff());
  if (!within(like, f)) return std::nullopt;
  f.equations = like.equations;
  f.torsion_range = like.torsion_range, f.rate_range = like.rate_range;
  f.slow_rate = like.slow_rate, f.speed_range = like.speed_range;
  f.torque_range = like.torque_range, f.session = like.session;
  f.firm_spring = like.firm_spring;
  return next;
}

std::vector<NextMotion> driven_motions(const Frame& like, const DriveModel& model) {
  const RigModel rig = specify(like, model).model;
  const double torque = largest(like, like.motor_torque);
  const double fast = like.fastest() / (2.0 * std::numbers::pi);
  const double slow = std::max(1.0 / like.duration, 1e-2 * fast);
  std::vector<NextMotion> list;
  for (const double share : kShares) {
    for (const double frequency : geometric(slow, fast, 6)) {
      if (auto next = driven_motion(like, rig, share * torque, frequency)) {
        list.push_back(std::move(*next));
      }
    }
  }
  return list;
}

}  // namespace

std::vector<NextMotion> next_motions(const Frame& like, const DriveModel& model) {
  return like.rig == Rig::free ? driven_motions(like, model) : imposed_motions(like, model);
}

}  // namespace flexspline::studies
