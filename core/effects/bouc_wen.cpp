#include <algorithm>
#include <cmath>

#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// Parameters: height H, slip length r, exponent n; one state z in [-1, 1].
struct BoucWen {
  template <class S>
  static S term(const Instant<S>&, std::span<const S> p, std::span<const S> z) {
    return S(p[0] * z[0]);
  }

  // dz/dx along a monotone piece of the path.
  template <class S>
  static S slope(const S& z, double direction, std::span<const S> p) {
    const S along(z * direction);
    const S power = positive_power(magnitude(along), p[2]);
    return S((real_part(along) < 0.0 ? S(1.0 + power) : S(1.0 - power)) / p[1]);
  }

  // Steps of at most a twentieth of the slip length, so that the sampling does not matter. What
  // lies before the last 500 slip lengths is forgotten at every exponent, and left out.
  template <class S>
  static void advance(const Instant<S>& from, const Instant<S>& to, std::span<const S> p,
                      std::span<S> z) {
    const S dx(limited(S(to.torsion - from.torsion), S(500.0 * p[1])));
    const double direction = real_part(dx) < 0.0 ? -1.0 : 1.0;
    const double ratio = 20.0 * std::abs(real_part(dx)) / real_part(p[1]);
    const int steps = static_cast<int>(std::clamp(std::ceil(ratio), 1.0, 1e4));
    const S step(dx / static_cast<double>(steps));
    for (int k = 0; k < steps; ++k) {
      const S middle(z[0] + S(0.5 * step) * slope(z[0], direction, p));
      z[0] = limited(S(z[0] + step * slope(limited(middle, S(1.0)), direction, p)), S(1.0));
    }
  }

  template <class S>
  static void rate(const Instant<S>& x, std::span<const S> p, std::span<const S> z,
                   std::span<S> dz) {
    const double direction = real_part(x.torsion_rate) < 0.0 ? -1.0 : 1.0;
    dz[0] = x.torsion_rate * slope(z[0], direction, p);
  }
};

}  // namespace

EffectRow describe_bouc_wen() {
  EffectRow row{.id = "bouc_wen",
                .coordinate = "reversal_memory",
                .site = Site::transmission,
                .equation = "tau += H z, z' = phi'/r (1 - sgn(z phi') |z|^n)",
                .range = "any motion; starts unloaded; Dahl's law at n = 1",
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
