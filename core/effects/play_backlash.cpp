#include <cmath>

#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// The state is the part of the torque that friction in the joint carries: a stop operator, so that
// tau - s is the play operator. Driven by the torque, not by the torsion, as only that loses
// energy.
struct PlayBacklash {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S> z) {
    using std::sqrt;
    const S play(x.transmitted_torque - z[0]);
    return S(-S(S(p[0] * play) / S(sqrt(S(S(play * play) + S(p[1] * p[1]))))));
  }

  template <class S>
  static void advance(const Instant<S>& from, const Instant<S>& to, std::span<const S> p,
                      std::span<S> z) {
    z[0] = limited(S(z[0] + S(to.transmitted_torque - from.transmitted_torque)), p[1]);
  }

  template <class S>
  static void rate(const Instant<S>& x, std::span<const S> p, std::span<const S> z,
                   std::span<S> dz) {
    dz[0] = stop_rate(z[0], x.transmitted_torque_rate, p[1]);
  }
};

}  // namespace

EffectRow describe_play_backlash() {
  EffectRow row{
      .id = "play_backlash",
      .coordinate = "reversal_memory",
      .site = Site::kinematics,
      .equation = "phi_e = phi - b p/sqrt(p^2 + T^2), p = tau - s, s' = tau' unless |s| = T (play)",
      .range = "any torque; the joint starts unstressed; loses energy over each cycle",
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
