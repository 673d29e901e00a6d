#pragma once

#include <span>

#include "diagnosis/frame/frame.hpp"

namespace flexspline::studies {

/// The speed, acceleration and position that an equation is about: of the motor, of the load, or
/// the torsion.
const Eigen::ArrayXd& speed_of(const Frame& frame, Equation equation);
const Eigen::ArrayXd& acceleration_of(const Frame& frame, Equation equation);
const Eigen::ArrayXd& position_of(const Frame& frame, Equation equation);

/// Way since the last reversal of every recording.
Eigen::ArrayXd since_reversal(const Frame& frame, const Eigen::ArrayXd& position,
                              const Eigen::ArrayXd& speed);

/// x/|x| rounded off below the width.
Eigen::ArrayXd rounded_sign(const Eigen::ArrayXd& x, double width);

/// Part of a sign that is rounded off: share tanh(x/width).
struct SignPart {
  double share = 1.0;
  double width = 1.0;
};

/// Sum of the parts.
Eigen::ArrayXd rounded_sign(const Eigen::ArrayXd& x, std::span<const SignPart> parts);

}  // namespace flexspline::studies
