#include "diagnosis/rate_error.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

/// Errors of the motor's speed and of the torsion's rate that come together.
struct RateError {
  ArrayXd speed, rate;
};

std::vector<RateError> independent_errors(const Frame& frame) {
  const ArrayXd none = ArrayXd::Zero(frame.rows());
  if (frame.rig == Rig::free) {
    return {{none, frame.torsion_rate_error}, {frame.motor_speed_error, none}};
  }
  return {{frame.ratio * frame.torsion_rate_error, frame.torsion_rate_error}};
}

PerEquation half_difference(const Frame& frame, const DriveModel& model, const Reference& reference,
                            const RateError& error) {
  Frame other = frame;
  other.kept.reset();  // columns of the motion as it was
  const auto residual_at = [&](double sign) {
    other.motor_speed = frame.motor_speed + sign * error.speed;
    other.torsion_rate = frame.torsion_rate + sign * error.rate;
    return evaluate(other, model, reference).residual;
  };
  PerEquation above = residual_at(1.0);
  const PerEquation below = residual_at(-1.0);
  for (std::size_t e = 0; e < above.size(); ++e) above[e] = 0.5 * (above[e] - below[e]).abs();
  return above;
}

}  // namespace

PerEquation torque_of_rate_error(const Frame& frame, const DriveModel& model,
                                 const Reference& reference) {
  PerEquation torque;
  if (!frame.has(Equation::torsion) || frame.torsion_rate_error.size() == 0) return torque;
  for (const RateError& error : independent_errors(frame)) {
    const PerEquation one = half_difference(frame, model, reference, error);
    for (std::size_t e = 0; e < torque.size(); ++e) {
      torque[e] = torque[e].size() == 0 ? one[e] : (torque[e].square() + one[e].square()).sqrt();
    }
  }
  return torque;
}

}  // namespace flexspline::studies
