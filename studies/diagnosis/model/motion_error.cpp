#include "diagnosis/model/motion_error.hpp"

#include <vector>

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
  // That of the load's acceleration is the noise of a torque that it tells.
  ArrayXd& across = half[index_of(Equation::torsion)];
  if (frame.torque_by_inertia && together.front().error == kLoad.error) across.setZero();
  return half;
}

}  // namespace

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
