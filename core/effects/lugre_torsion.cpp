#include <cmath>

#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// Parameters: bristle stiffness k, Coulomb and Stribeck torque, Stribeck rate, bristle damping. The
// state is the bristles' deflection in rad.
struct LuGre {
  // Deflection at which bristles slip steadily.
  template <class S>
  static S steady(const S& rate, std::span<const S> p) {
    return (p[1] + p[2] * bell(rate, p[3])) / p[0];
  }

  template <class S>
  static S deflection_rate(const S& rate, const S& z, std::span<const S> p) {
    return rate - magnitude(rate) * z / steady(rate, p);
  }

  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S> z) {
    const S& rate = x.torsion_rate;
    const S damping = p[4] * bell(rate, p[3]) * deflection_rate(rate, z[0], p);
    return p[0] * z[0] + damping;
  }

  // Exact for a constant rate between two samples.
  template <class S>
  static void advance(const Instant<S>& from, const Instant<S>& to, std::span<const S> p,
                      std::span<S> z) {
    using std::exp;
    const S dx = to.torsion - from.torsion;
    const double direction = real_part(dx) < 0.0 ? -1.0 : 1.0;
    const S limit = steady(0.5 * (from.torsion_rate + to.torsion_rate), p);
    const S end = limit * direction;
    z[0] = end - (end - z[0]) * exp((dx * -direction) / limit);
  }

  template <class S>
  static void rate(const Instant<S>& x, std::span<const S> p, std::span<const S> z,
                   std::span<S> dz) {
    dz[0] = deflection_rate(x.torsion_rate, z[0], p);
  }
};

}  // namespace

EffectRow describe_lugre_torsion() {
  EffectRow row{
      .id = "lugre_torsion",
      .coordinate = "reversal_memory",
      .site = Site::transmission,
      .equation = "tau += k z + d e z', z' = phi' - k |phi'| z/(C + S e), e = exp(-(phi'/v)^2)",
      .range = "any motion; starts unloaded; passive where d v <= 9 C",
      .not_modelled = "closed minor loops; viscous friction, which is the law's",
      .source = "Canudas de Wit, Olsson, Astrom, Lischinsky, IEEE TAC 40(3), 1995",
      .parameters = {{"stiffness", "Nm/rad", 1e-3, 1e8, 1.5e4, "4.5 Nm over 3e-4 rad"},
                     {"coulomb", "Nm", 1e-9, 1e6, 4.5, "Table I's half height"},
                     {"stribeck", "Nm", 0.0, 1e6, 0.5, "a tenth of the Coulomb torque"},
                     {"stribeck_rate", "rad/s", 1e-7, 1e3, 1e-3,
                      "ten times the speed amplitude of the identification of Table I"},
                     {"damping", "Nm s/rad", 0.0, 1e6, 5.0, "torsional damping: 5 to 50"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
      .states = 1};
  instantiate<LuGre>(row);
  return row;
}

}  // namespace flexspline
