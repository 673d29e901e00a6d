#include "diagnosis/model/motion_error.hpp"

#include <cmath>
#include <utility>

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

/// A motion of a frame, and its standard deviation by row.
struct Known {
  ArrayXd Frame::*motion;
  ArrayXd Frame::*error;
};

constexpr Known kTorsion = {&Frame::torsion, &Frame::torsion_error};
constexpr Known kRate = {&Frame::torsion_rate, &Frame::torsion_rate_error};
constexpr Known kSpeed = {&Frame::motor_speed, &Frame::motor_speed_error};
constexpr Known kMotor = {&Frame::motor_acceleration, &Frame::motor_acceleration_error};
constexpr Known kLoad = {&Frame::load_acceleration, &Frame::load_acceleration_error};

/// Independent errors, each of the motions that it moves together.
std::vector<std::vector<Known>> errors_on(Rig rig) {
  if (rig == Rig::free) return {{kTorsion}, {kRate}, {kSpeed}, {kMotor}, {kLoad}};
  if (rig == Rig::locked) return {{kTorsion}, {kRate, kSpeed}, {kMotor}};
  if (rig == Rig::servo) return {{kMotor, kLoad}};
  return {{kRate}};
}

// The error of a torque that an acceleration tells is its noise: what is left is by how much some
// rows are less known than their recording.
void take_off_noise(const Frame& frame, ArrayXd& error) {
  const std::vector<double> noise = levels_of_weighing(frame, Equation::torsion);
  for (std::size_t i = 0; i < noise.size(); ++i) {
    auto of_recording = error.segment(frame.segments[i].first, frame.segments[i].count);
    of_recording = (of_recording.square() - noise[i] * noise[i]).max(0.0).sqrt();
  }
}

PerEquation half_difference(const Frame& frame, const DriveModel& model, const Reference& reference,
                            const std::vector<Known>& together) {
  Frame other = frame;
  other.kept.reset();  // columns of the motion as it was
  const auto residual_at = [&](double sign) {
    for (const auto& [motion, error] : together) {
      if ((frame.*error).size() > 0) other.*motion = frame.*motion + sign * (frame.*error);
    }
    other.weigh_load();
    return evaluate(other, model, reference).residual;
  };
  PerEquation half = residual_at(1.0);
  const PerEquation below = residual_at(-1.0);
  for (std::size_t e = 0; e < half.size(); ++e) half[e] = 0.5 * (half[e] - below[e]).abs();
  if (together.front().error == kLoad.error)
    take_off_noise(frame, half[index_of(Equation::torsion)]);
  return half;
}

}  // namespace

std::vector<double> levels_of_weighing(const Frame& frame, Equation equation) {
  std::vector<double> levels(frame.segments.size(), 0.0);
  if (equation != Equation::torsion || !frame.torque_by_inertia) return levels;
  const ArrayXd rows = frame.rows_of(equation);
  const ArrayXd squares = (frame.load_inertia * frame.load_acceleration_error).square() * rows;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const auto [first, count] = std::pair(frame.segments[i].first, frame.segments[i].count);
    const double there = rows.segment(first, count).sum();
    if (there > 0.0) levels[i] = std::sqrt(squares.segment(first, count).sum() / there);
  }
  return levels;
}

PerEquation torque_of_motion_error(const Frame& frame, const DriveModel& model,
                                   const Reference& reference) {
  PerEquation torque;
  if (frame.torsion_rate_error.size() == 0) return torque;
  for (const auto& together : errors_on(frame.rig)) {
    const PerEquation one = half_difference(frame, model, reference, together);
    for (std::size_t e = 0; e < torque.size(); ++e) {
      torque[e] = torque[e].size() == 0 ? one[e] : (torque[e].square() + one[e].square()).sqrt();
    }
  }
  return torque;
}

}  // namespace flexspline::studies
