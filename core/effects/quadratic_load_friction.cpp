#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// Parameters: coefficient of the motor's torque, of the load's, Stribeck speed, widths of the sign
// and of the switches between the sides.
struct QuadraticLoadFriction {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    const S motor = x.motor_torque * x.motor_torque;
    const S torque = x.transmitted_torque / x.gear_ratio;
    const S load = torque * torque;
    const S width = p[4] * p[4];
    // Squared, so that little is left of it however hard both pull the same way.
    const S opposed = smooth_step(x.motor_torque * torque, width);
    const S loaded = opposed * opposed;
    const S driving = smooth_step(motor - load, width);
    const S driven = smooth_step(load - motor, width);
    const S squeeze = p[1] * load * driving + p[0] * motor * driven;
    return loaded * squeeze * bell(x.motor_speed, p[2]) * smooth_sign(x.motor_speed, p[3]);
  }
};

}  // namespace

EffectRow describe_quadratic_load_friction() {
  EffectRow row{
      .id = "quadratic_load_friction",
      .coordinate = "load",
      .site = Site::motor,
      .equation =
          "tau_f += exp(-(w/ws)^2) tanh(w/we) Q, Q = ke (tau/N)^2 if |tau_m| > |tau|/N, else "
          "km tau_m^2; 0 unless both pull against each other",
      .range =
          "sliding, driving or back-driving; switches are smooth over te^2 and 2 % off at 5 te^2",
      .not_modelled =
          "the linear part (directional_load_friction); an exponent of the Stribeck "
          "weight other than 2",
      .source = "Duclusaud, Passault, Padois, Ly, ICRA 2025 (BAM), model M6 as in its code",
      .parameters = {{"motor_quadratic", "1/Nm", 0.0, 1e4, 0.01,
                      "5 % at rated torque / N (judgement); BAM's MX-106: 0.01 at the output"},
                     {"load_quadratic", "1/Nm", 0.0, 1e4, 0.01,
                      "5 % at rated torque / N (judgement); BAM's MX-106: 7e-5 at the output"},
                     {"stribeck_speed", "rad/s", 1e-6, 1e6, 90.0,
                      "BAM: 1.8 rad/s at the output (eRob80:100, MX-106)"},
                     {"smoothing", "rad/s", 1e-9, 100.0, 0.5, "0.2 to 1 rad/s at the motor"},
                     {"load_smoothing", "Nm", 1e-9, 1e3, 0.1, "2 % of rated torque / N"}},
      .rigs = {Rig::locked, Rig::free, Rig::servo}};
  instantiate<QuadraticLoadFriction>(row);
  return row;
}

}  // namespace flexspline
