#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// Parameters: Coulomb torque, viscous coefficient, width of the sign.
struct CoulombViscous {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    return p[0] * smooth_sign(x.motor_speed, p[2]) + p[1] * x.motor_speed;
  }
};

}  // namespace

EffectRow describe_coulomb_viscous_friction() {
  EffectRow row{
      .id = "coulomb_viscous_friction",
      .coordinate = "velocity",
      .site = Site::motor,
      .equation = "tau_f += tc tanh(w/we) + B w, w = motor speed",
      .range =
          "sliding; the tanh is within 1 % of the sign beyond 2.7 we, and creeps where a real "
          "bearing sticks",
      .not_modelled = "stiction and presliding; load, angle and temperature",
      .source = "Dhaouadi and Ghorbel (2003), eq. (5)",
      .parameters =
          {{"coulomb", "Nm", 0.0, 1e6, 0.06,
            "starting torque of units of 51 to 226 Nm: 1 to 2 % of rated torque / N"},
           {"viscous", "Nm s/rad", 0.0, 1e6, 6e-4,
            "Schaeffler TPI 275: no-load running torque at 2000 rpm less starting torque"},
           {"smoothing", "rad/s", 1e-9, 100.0, 0.5,
            "well below the slowest speed held: 0.2 to 1 rad/s"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo}};
  instantiate<CoulombViscous>(row);
  return row;
}

}  // namespace flexspline
