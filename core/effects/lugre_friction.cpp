#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// Parameters: Coulomb torque, static less Coulomb torque, Stribeck speed, slip length, damping.
// One state: deflection of the bristles.
struct LuGre {
  // Deflection while sliding at that speed.
  template <class S>
  static S reach(const S& speed, std::span<const S> p) {
    return p[3] * (1.0 + p[1] / p[0] * bell(speed, p[2]));
  }

  template <class S>
  static S deflection_rate(const Instant<S>& x, std::span<const S> p, std::span<const S> z) {
    const S held = magnitude(x.motor_speed) * z[0];
    return x.motor_speed - held / reach(x.motor_speed, p);
  }

  // The damping falls as 4 g/|w| at most, below which the law is passive at any speed.
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S> z) {
    const S stiffness = p[0] / p[3];
    const S level = stiffness * reach(x.motor_speed, p);
    const S fade = 1.0 + p[4] * magnitude(x.motor_speed) / (4.0 * level);
    return stiffness * z[0] + p[4] / fade * deflection_rate(x, p, z);
  }

  // Exact at constant speed over the sample.
  template <class S>
  static void advance(const Instant<S>& from, const Instant<S>& to, std::span<const S> p,
                      std::span<S> z) {
    const S moved = to.motor_angle - from.motor_angle;
    const S top = reach(0.5 * (from.motor_speed + to.motor_speed), p);
    const S goal = real_part(moved) < 0.0 ? S(-top) : top;
    z[0] += (goal - z[0]) * relaxed(magnitude(moved) / top);
  }

  template <class S>
  static void rate(const Instant<S>& x, std::span<const S> p, std::span<const S> z,
                   std::span<S> dz) {
    dz[0] = deflection_rate(x, p, z);
  }
};

}  // namespace

EffectRow describe_lugre_friction() {
  EffectRow row{
      .id = "lugre_friction",
      .coordinate = "reversal_memory",
      .site = Site::motor,
      .equation =
          "tau_f += s0 z + s1(w) z', z' = w - s0 |w| z/g, g = tc + (ts - tc) exp(-(w/ws)^2), "
          "s0 = tc/r, s1(w) = s1/(1 + s1 |w|/(4 g))",
      .range = "presliding and sliding; starts unloaded; the viscous share s2 w is the baseline's",
      .not_modelled = "closed minor loops: one state drifts under small load cycles",
      .source =
          "Canudas de Wit, Olsson, Astrom, Lischinsky, IEEE TAC 40(3), 1995; passive damping "
          "after Barahona and Canudas de Wit, IEEE TCST 8(3), 2000",
      .parameters = {{"coulomb", "Nm", 1e-9, 1e6, 0.06, "starting torque, 1 to 2 % of rated / N"},
                     {"excess", "Nm", 0.0, 1e6, 0.018, "ts/tc = 1.1 to 1.5"},
                     {"stribeck_speed", "rad/s", 1e-6, 1e4, 10.0, "1 to 30 rad/s at the motor"},
                     {"slip_length", "rad", 1e-7, 10.0, 0.02, "5 to 50 mrad at the motor"},
                     {"damping", "Nm s/rad", 0.0, 1e6, 0.05,
                      "about critical: sqrt(s0 J) with J = 7.26e-4 kg m2, Table II"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
      .states = 1};
  instantiate<LuGre>(row);
  return row;
}

}  // namespace flexspline
