#include <cmath>

#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// The state is the play operator's, in units of T: the torque less what friction in the joint
// carries. Driven by the torque, not by the torsion, as only that loses energy.
struct PlayBacklash {
  // What the torque exceeds the friction by, in units of T.
  template <class S>
  static S excess(const Instant<S>& x, std::span<const S> p, const S& play) {
    const S apart = x.transmitted_torque / p[1] - play;
    return apart - limited(apart, S(1.0));
  }

  template <class S>
  static S term(const Instant<S>&, std::span<const S> p, std::span<const S> z) {
    using std::sqrt;
    return -p[0] * z[0] / sqrt(z[0] * z[0] + 1.0);
  }

  // The joint creeps after the excess: its friction is T (1 + z' t), by which it can be integrated.
  static constexpr double kCreepSeconds = 1e-5;

  template <class S>
  static void advance(const Instant<S>& from, const Instant<S>& to, std::span<const S> p,
                      std::span<S> z) {
    using std::exp;
    const S left = exp((from.time - to.time) / kCreepSeconds);
    z[0] += excess(to, p, z[0]) * (1.0 - left);
  }

  template <class S>
  static void rate(const Instant<S>& x, std::span<const S> p, std::span<const S> z,
                   std::span<S> dz) {
    dz[0] = excess(x, p, z[0]) / kCreepSeconds;
  }
};

}  // namespace

EffectRow describe_play_backlash() {
  EffectRow row{
      .id = "play_backlash",
      .coordinate = "reversal_memory",
      .site = Site::kinematics,
      .equation = "phi_e = phi - b z/sqrt(z^2 + 1), T z = tau - s, s' = tau' unless |s| = T (play)",
      .range =
          "any torque; the joint starts at the centre of its gap; loses energy over each cycle; "
          "in rigs its friction grows by T z' 10 us, so that it can be integrated: motion and "
          "torque undo each other there, and differ from the play of samples by that lag",
      .not_modelled = "impacts; a friction of the joint that depends on speed",
      .source = "Krasnosel'skii, Pokrovskii, Systems with Hysteresis (1989): play operator",
      .parameters = {{"half_gap", "rad", 0.0, 0.2, 1e-4, "Oldham coupling: 5 to 30 arcsec"},
                     {"friction", "Nm", 1e-9, 1e5, 4.5, "2 % of 226 Nm: Table I's half height"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen},
      .states = 1,
      .rate_independent = true};
  instantiate<PlayBacklash>(row);
  return row;
}

}  // namespace flexspline
