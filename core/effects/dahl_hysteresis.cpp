#include <cmath>

#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// Parameters: height H, slip length r; one state z in [-1, 1]. Exact along a monotone piece.
struct Dahl {
  template <class S>
  static S term(const Instant<S>&, std::span<const S> p, std::span<const S> z) {
    return p[0] * z[0];
  }

  template <class S>
  static void advance(const Instant<S>& from, const Instant<S>& to, std::span<const S> p,
                      std::span<S> z) {
    using std::exp;
    const S dx = to.torsion - from.torsion;
    const double direction = real_part(dx) < 0.0 ? -1.0 : 1.0;
    const S left = exp((dx * -direction) / p[1]);
    z[0] = direction - (direction - z[0]) * left;
  }

  template <class S>
  static void rate(const Instant<S>& x, std::span<const S> p, std::span<const S> z,
                   std::span<S> dz) {
    const S direction = where_negative(x.torsion_rate, S(-1.0), S(1.0));
    dz[0] = x.torsion_rate / p[1] * (1.0 - z[0] * direction);
  }
};

}  // namespace

EffectRow describe_dahl_hysteresis() {
  EffectRow row{.id = "dahl_hysteresis",
                .coordinate = "reversal_memory",
                .site = Site::transmission,
                .equation = "tau += H z, z' = phi'/r (1 - sgn(phi') z)",
                .range = "any motion; starts unloaded; bouc_wen at n = 1, solved exactly",
                .not_modelled = "closed minor loops: one state forgets where it turned",
                .source = "Dahl, Aerospace Corp. TOR-0158(3107-18)-1 (1968)",
                .parameters = {{"height", "Nm", 0.0, 1e6, 4.5, "Table I's half height"},
                               {"slip_length", "rad", 1e-7, 0.1, 3e-4,
                                "catalogue hysteresis of ratio 50: 2 arcmin"}},
                .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
                .states = 1,
                .rate_independent = true};
  instantiate<Dahl>(row);
  return row;
}

}  // namespace flexspline
