#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/frame/coordinates.hpp"
#include "flexspline/core/model_spec.hpp"

namespace flexspline::studies {

/// A cause as it was fitted, for its counterpart in the catalogue of effects.
struct FittedCause {
  const Frame& frame;
  std::span<const double> shape;
  const Eigen::VectorXd& coefficients;
  std::span<const SignPart> motor_sign;    ///< of its dry friction; shares add up to one
  std::span<const SignPart> torsion_sign;  ///< the same across the gear
  double slipping = 0.0;                   ///< largest friction across the gear beside g^-1, Nm
};

/// What a cause is in a model file.
struct Counterpart {
  std::vector<EffectSpec> effects = {};
  double motor_inertia = 0.0;  ///< added to the rig's, kg m2
  double load_inertia = 0.0;
  double law_factor = 1.0;         ///< on f and g^-1, which had taken a gain up
  double side_difference = 0.0;    ///< g^-1 is 1 + this forward and 1 - this backward
  double spring_difference = 0.0;  ///< f is 1 + this on its positive side and 1 - this on the other
  /// Of the torsion, where f alone sees less of it.
  std::function<double(double)> spring_sees = {};
  std::string caveat = {};  ///< in what the model differs from what was fitted
};

/// Said of what goes by the clock of a session.
inline constexpr const char* kSessionClock =
    "its time is that of the session, from the first recording's start on; simulate counts from "
    "each recording's own";

/// (amplitude, phase) of s sin(x) + c cos(x) = amplitude sin(x + phase), by those names; with the
/// order between them where there is one.
std::vector<std::pair<std::string, double>> amplitude_and_phase(double s, double c);
std::vector<std::pair<std::string, double>> harmonic(double order, double s, double c);

/// An effect a part of a sign: parameters(share, width).
std::vector<EffectSpec> by_sign_part(
    std::span<const SignPart> sign, std::string_view effect,
    const std::function<std::vector<std::pair<std::string, double>>(double, double)>& parameters);

}  // namespace flexspline::studies
