
#include "flexspline/core/effect.hpp"
#include "unit_hysteresis.hpp"

namespace flexspline {
namespace {

// Parameters: height H, slip length r, exponent n; one state z in [-1, 1].
struct BoucWen {
  template <class S>
  static S term(const Instant<S>&, std::span<const S> p, std::span<const S> z) {
    return p[0] * z[0];
  }

  // Exact along a monotone piece. What lies before the last 500 slip lengths is forgotten at every
  // exponent, and left out.
  template <class S>
  static void advance(const Instant<S>& from, const Instant<S>& to, std::span<const S> p,
                      std::span<S> z) {
    const S moved = limited((to.torsion - from.torsion) / p[1], S(500.0));
    const double direction = real_part(moved) < 0.0 ? -1.0 : 1.0;
    z[0] = direction * along_unit_hysteresis(direction * z[0], direction * moved, p[2]);
  }

  template <class S>
  static void rate(const Instant<S>& x, std::span<const S> p, std::span<const S> z,
                   std::span<S> dz) {
    const S direction = where_negative(x.torsion_rate, S(-1.0), S(1.0));
    dz[0] = x.torsion_rate / p[1] * unit_hysteresis_slope(S(direction * z[0]), p[2]);
  }
};

}  // namespace

EffectRow describe_bouc_wen() {
  EffectRow row{
      .id = "bouc_wen",
      .coordinate = "reversal_memory",
      .site = Site::transmission,
      .equation = "tau += H z, z' = phi'/r (1 - sgn(z phi') |z|^n)",
      .range = "any motion, solved exactly along it; starts unloaded; Dahl's law at n = 1",
      .not_modelled = "closed minor loops: one state forgets where it turned",
      .source = "Dahl (1968), Wen (1976); Ismail, Ikhouane, Rodellar (2009)",
      .parameters = {{"height", "Nm", 0.0, 1e6, 4.5, "Table I's half height"},
                     {"slip_length", "rad", 1e-7, 0.1, 3e-4,
                      "catalogue hysteresis of ratio 50: 2 arcmin"},
                     {"exponent", "1", 0.2, 5.0, 1.0, "Dahl (1968) at 1"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
      .states = 1,
      .rate_independent = true};
  instantiate<BoucWen>(row);
  return row;
}

}  // namespace flexspline
