#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// Parameters: half differences of Coulomb torque and of viscous coefficient, width of the sign.
struct DirectionAsymmetry {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    const S sign = smooth_sign(x.motor_speed, p[2]);
    return p[0] * sign * sign + p[1] * smooth_magnitude(x.motor_speed, p[2]);
  }
};

}  // namespace

EffectRow describe_direction_asymmetry() {
  EffectRow row{
      .id = "direction_asymmetry",
      .coordinate = "velocity",
      .site = Site::motor,
      .equation = "tau_f += dtc tanh^2(w/we) + dB |w|, |w| = sqrt(w^2 + we^2) - we",
      .range =
          "beside a symmetric friction with tc >= |dtc| and B >= |dB|, with which the sum is "
          "passive; within 2 % beyond 2.7 we, |w| short by at most we",
      .not_modelled =
          "separation from an offset of the motor torque, confounded with it while moving; a "
          "Stribeck peak of one direction",
      .source = "Compliant Joint Toolbox (separate parameters a direction)",
      .parameters = {{"coulomb_difference", "Nm", -1e6, 1e6, 6e-3,
                      "half of forward less backward: 5 to 20 % of tc (judgement)"},
                     {"viscous_difference", "Nm s/rad", -1e6, 1e6, 6e-5,
                      "half of forward less backward: 5 to 20 % of B (judgement)"},
                     {"smoothing", "rad/s", 1e-9, 100.0, 0.5, "0.2 to 1 rad/s at the motor"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
      .passive = false,
      .active_because =
          "half a friction: passive beside Coulomb tc >= |dtc| and viscous B >= |dB|"};
  instantiate<DirectionAsymmetry>(row);
  return row;
}

}  // namespace flexspline
