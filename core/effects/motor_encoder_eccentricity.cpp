#include <cmath>

#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

struct MotorEncoderEccentricity {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    using std::sin;
    return p[0] * sin(x.motor_angle + p[1]);
  }
};

}  // namespace

EffectRow describe_motor_encoder_eccentricity() {
  EffectRow row{.id = "motor_encoder_eccentricity",
                .coordinate = "motor_angle",
                .site = Site::motor_angle_signal,
                .equation = "theta_m,measured = theta_m + a sin(theta_m + p)",
                .range = "any angle; order 1 of the motor's encoder, with no torque behind it",
                .not_modelled = "interpolation errors of the line order",
                .source = "a disc of radius R off centre by e reads e/R too much",
                .parameters = {{"amplitude", "rad", 0.0, 0.5, 1e-3, "15 um at a radius of 15 mm"},
                               {"phase", "rad", -3.2, 3.2, 0.0, "depends on the assembly"}},
                .rigs = {Rig::locked, Rig::free},
                .passive = false,
                .active_because = "an instrument: it shows what is not there, and does no work",
                .rate_independent = true};
  instantiate<MotorEncoderEccentricity>(row);
  return row;
}

}  // namespace flexspline
