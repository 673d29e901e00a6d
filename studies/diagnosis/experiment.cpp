#include "diagnosis/experiment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr Index kSamples = 600;
constexpr double kCycles = 3.0;

// A frame of one sine of torsion, the motor following.
Frame sine_frame(const Frame& like, double amplitude, double frequency) {
  Frame f = like;
  const double w = 2.0 * std::numbers::pi * frequency;
  f.segments = {{"next", 0, kSamples, Split::train}};
  f.time = ArrayXd::LinSpaced(kSamples, 0.0, kCycles / frequency);
  f.clock = f.time;
  const ArrayXd s = (w * f.time).sin();
  const ArrayXd c = (w * f.time).cos();
  f.torsion = amplitude * s;
  f.torsion_rate = amplitude * w * c;
  f.torsion_acceleration = -amplitude * w * w * s;
  const double turns = f.rig == Rig::locked || f.travels ? f.ratio : 1.0;
  f.motor_angle = turns * f.torsion, f.motor_speed = turns * f.torsion_rate;
  f.motor_acceleration = turns * f.torsion_acceleration;
  for (ArrayXd* zero :
       {&f.load_angle, &f.load_speed, &f.load_acceleration, &f.torque, &f.smooth_torque,
        &f.torque_rate, &f.motor_torque, &f.smooth_motor_torque, &f.motor_torque_rate}) {
    zero->setZero(kSamples);
  }
  f.usable = ArrayXd::Ones(kSamples);
  f.equations = {Equation::torsion};
  return f;
}

ArrayXd predicted(const Frame& frame, const DriveModel& model) {
  const auto fit = evaluate(frame, model, reference_of(frame, model));
  return fit.prediction[index_of(Equation::torsion)];
}

double separation(const Frame& like, const DriveModel& a, const DriveModel& b, double noise,
                  double amplitude, double frequency) {
  const Frame frame = sine_frame(like, amplitude, frequency);
  return (predicted(frame, a) - predicted(frame, b)).matrix().norm() / noise;
}

const Trial* closest_rival(const Selection& s) {
  if (s.accepted.empty()) return nullptr;
  const Accepted& first = s.accepted.front();
  if (!first.rivals.empty()) return &first.rivals.front();
  return first.field.empty() || first.field.front().cause.row == nullptr ? nullptr
                                                                         : &first.field.front();
}

bool on_torsion(const Trial& trial) { return trial.cause.form->at.front() == Equation::torsion; }

}  // namespace

bool one_loop(const Frame& frame) {
  if (frame.travels || !frame.has(Equation::torsion) || frame.rig == Rig::free) return false;
  const auto alike = [](const ArrayXd& channel, const Frame& f) {
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (const Segment& s : f.segments) {
      const double range = channel.segment(s.first, s.count).abs().maxCoeff();
      least = std::min(least, range);
      most = std::max(most, range);
    }
    return least > 0.9 * most;
  };
  return alike(frame.torsion, frame) && alike(frame.torsion_rate, frame);
}

NextExperiment another_rate(const Frame& frame) {
  NextExperiment next;
  next.separates = {"presliding_hysteresis", "viscous damping"};
  next.excitation = "sine";
  next.amplitude = frame.torsion_range;
  next.frequency_hz = 0.25 * frame.rate_range / (2.0 * std::numbers::pi * frame.torsion_range);
  next.says = fmt::format(
      "the same amplitude at {:.3g} Hz: what is viscous shrinks with the rate, what is a memory "
      "does "
      "not",
      next.frequency_hz);
  return next;
}

std::optional<NextExperiment> next_experiment(const Frame& frame, const Selection& s) {
  const Trial* rival = closest_rival(s);
  if (rival == nullptr || frame.rig == Rig::free || frame.travels) return std::nullopt;
  const Trial& best = s.accepted.front().trial;
  if (!on_torsion(best) || !on_torsion(*rival)) return std::nullopt;
  const double noise = s.final.noise[index_of(Equation::torsion)].level.front();
  const double fast = frame.rate_range / (2.0 * std::numbers::pi * frame.torsion_range);
  const double slow = std::max(0.3 / frame.duration, 1e-4 * fast);
  NextExperiment next;
  next.separation_sigma = 0.0;
  for (double share : {0.1, 0.25, 0.5, 0.75, 1.0}) {
    for (double frequency : geometric(slow, 3.0 * fast, 8)) {
      const double amplitude = share * frame.torsion_range;
      const double sigma =
          separation(frame, best.fit.model, rival->fit.model, noise, amplitude, frequency);
      if (!(sigma > next.separation_sigma)) continue;
      next.separation_sigma = sigma;
      next.amplitude = amplitude;
      next.frequency_hz = frequency;
    }
  }
  if (!(next.separation_sigma > 0.0)) return std::nullopt;
  next.separates = {std::string(best.cause.row->id), std::string(rival->cause.row->id)};
  next.excitation = "sine";
  next.says =
      fmt::format("sine of {:.3g} Hz, three cycles: expected to separate {} from {} (z = {:.0f})",
                  next.frequency_hz, next.separates[0], next.separates[1], next.separation_sigma);
  return next;
}

}  // namespace flexspline::studies
