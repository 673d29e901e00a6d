#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// Parameters: share of the motor's torque, of the load's, Stribeck speed, exponent, widths of the
// sign and of the magnitude. The load pulls against the motor, so that the difference of M5 is a
// sum here.
struct StribeckLoadFriction {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    using std::exp;
    const S squeeze = p[0] * x.motor_torque + p[1] * x.transmitted_torque / x.gear_ratio;
    const S left = exp(-positive_power(S(magnitude(x.motor_speed) / p[2]), p[3]));
    return smooth_magnitude(squeeze, p[5]) * left * smooth_sign(x.motor_speed, p[4]);
  }
};

}  // namespace

EffectRow describe_stribeck_load_friction() {
  EffectRow row{
      .id = "stribeck_load_friction",
      .coordinate = "load",
      .site = Site::motor,
      .equation =
          "tau_f += |km tau_m + ke tau/N| exp(-|w/ws|^d) tanh(w/we), |x| = sqrt(x^2 + te^2) - te",
      .range =
          "sliding, driving or back-driving; short of the magnitude by at most te; beside "
          "directional_load_friction or load_dependent_friction, to which it adds near rest; "
          "where the motor torque is a result, an implicit equation with one solution where the "
          "shares km of all effects stay below 1 together",
      .not_modelled =
          "dependence on the time at rest; growth faster than the load "
          "(quadratic_load_friction)",
      .source = "Duclusaud, Passault, Padois, Ly, ICRA 2025 (BAM), model M5; M4 where km = ke",
      .parameters = {{"motor_share", "1", 0.0, 0.9, 0.02,
                      "a quarter of directional_load_friction (judgement); BAM's bound: 1"},
                     {"load_share", "1", 0.0, 2.0, 0.02, "as motor_share"},
                     {"stribeck_speed", "rad/s", 1e-6, 1e4, 10.0, "1 to 30 rad/s at the motor"},
                     {"exponent", "1", 0.5, 4.0, 2.0,
                      "Armstrong-Helouvry et al. (1994): 0.5 to 2; BAM fits up to 3"},
                     {"smoothing", "rad/s", 1e-9, 100.0, 0.5, "0.2 to 1 rad/s at the motor"},
                     {"load_smoothing", "Nm", 1e-9, 1e3, 1e-3,
                      "a tenth of the friction at 0.2 % of rated torque / N"}},
      .rigs = {Rig::locked, Rig::free, Rig::servo}};
  instantiate<StribeckLoadFriction>(row);
  return row;
}

}  // namespace flexspline
