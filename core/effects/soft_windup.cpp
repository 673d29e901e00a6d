#include <cmath>

#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

struct SoftWindup {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    using std::tanh;
    const S soft = p[1] * tanh(x.torsion / p[1]);
    return p[0] * (x.torsion - soft);
  }
};

}  // namespace

EffectRow describe_soft_windup() {
  EffectRow row{
      .id = "soft_windup",
      .coordinate = "torsion",
      .site = Site::transmission,
      .equation = "tau += (K3 - K1) (phi - p tanh(phi/p)): slope 0 at rest, K3 - K1 far beyond p",
      .range = "up to the momentary peak torque; K1 is the law's slope at rest",
      .not_modelled = "the middle stiffness K2 as a step of its own; ratcheting",
      .source = "stiffnesses K1, K2, K3 of catalogues; Tuttle, Seering, IEEE T-RA 12(3), 1996",
      .parameters = {{"stiffening", "Nm/rad", 0.0, 1e7, 1.1e5,
                      "K3 - K1 = (26 - 15)e4 Nm/rad, size 45, ratio 50"},
                     {"knee", "rad", 1e-7, 1.0, 5e-4, "T1/K1 = 76 Nm / 15e4 Nm/rad, size 45"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
      .rate_independent = true};
  instantiate<SoftWindup>(row);
  return row;
}

}  // namespace flexspline
