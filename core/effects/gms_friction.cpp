#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

constexpr std::size_t kGroup = 5;

// Parameters of an element: stiffness, yield, excess of the static yield, Stribeck speed, time
// constant of the frictional lag. State of an element: deflection.
struct MaxwellSlipStribeck {
  template <class S>
  static S yield_at(const S& speed, std::span<const S> p) {
    return p[1] * (1.0 + p[2] * bell(speed, p[3]));
  }

  template <class S>
  static S term(const Instant<S>&, std::span<const S> p, std::span<const S> z) {
    S sum(0.0);
    for (std::size_t k = 0; k < z.size(); ++k) sum += p[k * kGroup] * z[k];
    return sum;
  }

  // Exact at constant speed over the sample. Beyond its yield, which falls with speed, an element
  // slips and gives way with the lag; below, it sticks until it gets there.
  template <class S>
  static void advance(const Instant<S>& from, const Instant<S>& to, std::span<const S> p,
                      std::span<S> z) {
    const S moved = to.motor_angle - from.motor_angle;
    const S elapsed = to.time - from.time;
    const S speed = 0.5 * (from.motor_speed + to.motor_speed);
    const double direction = real_part(moved) < 0.0 ? -1.0 : 1.0;
    for (std::size_t k = 0; k < z.size(); ++k) {
      const auto own = p.subspan(k * kGroup, kGroup);
      const S yield = yield_at(speed, own);
      const S along = direction * z[k];
      const S stuck = along + direction * moved;
      if (real_part(stuck) <= real_part(yield) || real_part(moved) == 0.0) {
        z[k] = direction * stuck;
      } else if (real_part(along) <= real_part(yield)) {
        z[k] = direction * yield;
      } else {
        z[k] += direction * (yield - along) * relaxed(elapsed / own[4]);
      }
    }
  }

  template <class S>
  static void rate(const Instant<S>& x, std::span<const S> p, std::span<const S> z,
                   std::span<S> dz) {
    const S& v = x.motor_speed;
    const S direction = where_negative(v, S(-1.0), S(1.0));
    for (std::size_t k = 0; k < z.size(); ++k) {
      const auto own = p.subspan(k * kGroup, kGroup);
      const S yield = yield_at(x.motor_speed, own);
      const S beyond = direction * z[k] - yield;
      const S slipping = (-direction * beyond) / own[4];
      dz[k] = x.motor_speed + slips(beyond, yield, v) * (slipping - x.motor_speed);
    }
  }

  // From sticking (0) to slipping (1) over the last 1e-6 of the yield: while the yield rises with
  // falling speed an element stays at it, which a switch would chatter around.
  template <class S>
  static S slips(const S& beyond, const S& yield, const S& speed) {
    const S share = 1.0 + beyond / (1e-6 * yield);
    const S rising = where_negative(share, S(0.0), share);
    const S moving = where_negative(S(1.0 - share), S(1.0), rising);
    return where_negative(S(-magnitude(speed)), moving, S(0.0));
  }
};

}  // namespace

EffectRow describe_gms_friction() {
  EffectRow row{
      .id = "gms_friction",
      .coordinate = "reversal_memory",
      .site = Site::motor,
      .equation =
          "tau_f += sum_i k_i z_i; sticks: z_i' = w; slips at |z_i| >= r_i(w) = r_i (1 + e_i "
          "exp(-(w/ws)^2)): z_i' = sgn(w) (r_i(w) - |z_i|)/T",
      .range =
          "presliding and sliding; starts unloaded; closes minor loops at speeds well below ws; in "
          "rigs an element begins to slip over the last 1e-6 of its yield",
      .not_modelled = "viscous share (the baseline's); yields that depend on load or temperature",
      .source = "Al-Bender, Lampaert, Swevers, IEEE TAC 50(11), 2005",
      .parameters = {{"stiffness", "Nm/rad", 0.0, 1e9, 3.0, "tc = 0.06 Nm over 20 mrad"},
                     {"yield", "rad", 1e-7, 10.0, 0.02, "5 to 50 mrad at the motor"},
                     {"excess", "1", 0.0, 5.0, 0.3, "ts/tc - 1 = 0.1 to 0.5"},
                     {"stribeck_speed", "rad/s", 1e-6, 1e4, 10.0, "1 to 30 rad/s at the motor"},
                     {"lag", "s", 1e-6, 10.0, 5e-3,
                      "frictional lag: 3 to 9 ms, Hess and Soom (1990)"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
      .repeats = true,
      .states = 1};
  instantiate<MaxwellSlipStribeck>(row);
  return row;
}

}  // namespace flexspline
