#include "diagnosis/frame/coordinates.hpp"

#include <cmath>

namespace flexspline::studies {

using Eigen::ArrayXd;
using Eigen::Index;

const ArrayXd& speed_of(const Frame& f, Equation equation) {
  if (equation == Equation::motor) return f.motor_speed;
  return equation == Equation::load ? f.load_speed : f.torsion_rate;
}

const ArrayXd& acceleration_of(const Frame& f, Equation equation) {
  if (equation == Equation::motor) return f.motor_acceleration;
  return equation == Equation::load ? f.load_acceleration : f.torsion_acceleration;
}

const ArrayXd& position_of(const Frame& f, Equation equation) {
  if (equation == Equation::motor) return f.motor_angle;
  return equation == Equation::load ? f.load_angle : f.torsion;
}

ArrayXd since_reversal(const Frame& f, const ArrayXd& position, const ArrayXd& speed) {
  ArrayXd way(f.rows());
  for (const Segment& s : f.segments) {
    double turned_at = position[s.first];
    for (Index r = s.first; r < s.first + s.count; ++r) {
      if (r > s.first && speed[r] * speed[r - 1] <= 0.0) turned_at = position[r];
      way[r] = std::abs(position[r] - turned_at);
    }
  }
  return way;
}

// tanh by an exponential, which Eigen computes several at a time.
Eigen::ArrayXd rounded_sign(const Eigen::ArrayXd& x, double width) {
  const Eigen::ArrayXd small = (x.abs() * (-2.0 / width)).exp();
  return x.sign() * (1.0 - small) / (1.0 + small);
}

Eigen::ArrayXd rounded_sign(const Eigen::ArrayXd& x, std::span<const SignPart> parts) {
  Eigen::ArrayXd sign = Eigen::ArrayXd::Zero(x.size());
  for (const SignPart& part : parts) sign += part.share * rounded_sign(x, part.width);
  return sign;
}

}  // namespace flexspline::studies
