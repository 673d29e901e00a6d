#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// Parameters: static less Coulomb torque, Stribeck speed, exponent, width of the sign.
struct Stribeck {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    using std::exp;
    const S ratio = magnitude(x.motor_speed) / p[1];
    const S left = exp(-positive_power(ratio, p[2]));
    return p[0] * left * smooth_sign(x.motor_speed, p[3]);
  }
};

}  // namespace

EffectRow describe_stribeck_friction() {
  EffectRow row{
      .id = "stribeck_friction",
      .coordinate = "velocity",
      .site = Site::motor,
      .equation = "tau_f += (ts - tc) exp(-|w/ws|^d) tanh(w/we), w = motor speed",
      .range = "sliding; with we <= ws/20 and d = 2 the peak is within 5 % of ts - tc",
      .not_modelled = "frictional lag, presliding, dependence of ts on the time at rest",
      .source =
          "Stribeck (1902); Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30(7), 1994",
      .parameters = {{"excess", "Nm", 0.0, 1e6, 0.018, "ts/tc = 1.1 to 1.5; 0 in some units (BAM)",
                      linear("of the friction at rest over that in motion")},
                     {"stribeck_speed", "rad/s", 1e-6, 1e4, 10.0, "1 to 30 rad/s at the motor",
                      shape("at which the excess has fallen to 1/e", 0.003, 0.6, Scale::motor_speed,
                            6)},
                     {"exponent", "1", 0.5, 4.0, 2.0,
                      "Armstrong-Helouvry et al. (1994): 0.5 to 2; BAM fits up to 3",
                      shape("of the speed", 0.5, 3.0)},
                     {"smoothing", "rad/s", 1e-9, 100.0, 0.5, "0.2 to 1 rad/s at the motor",
                      sign_width()}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo}};
  instantiate<Stribeck>(row);
  return row;
}

}  // namespace flexspline
