#include <cmath>

#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// Parameters (stiffness, time constant) and the strain s of the spring of every branch. Exact where
// the torsion is linear in time between two samples.
struct ViscoelasticCreep {
  template <class S>
  static S term(const Instant<S>&, std::span<const S> p, std::span<const S> z) {
    S sum(0.0);
    for (std::size_t k = 0; k < z.size(); ++k) sum += p[2 * k] * z[k];
    return sum;
  }

  template <class S>
  static void advance(const Instant<S>& from, const Instant<S>& to, std::span<const S> p,
                      std::span<S> z) {
    using std::exp;
    const S dx = to.torsion - from.torsion;
    for (std::size_t k = 0; k < z.size(); ++k) {
      const S elapsed = (to.time - from.time) / p[2 * k + 1];
      const S left = exp(S(-elapsed));
      z[k] = z[k] * left + dx * mean_left(elapsed);
    }
  }

  template <class S>
  static void rate(const Instant<S>& x, std::span<const S> p, std::span<const S> z,
                   std::span<S> dz) {
    for (std::size_t k = 0; k < z.size(); ++k) dz[k] = x.torsion_rate - z[k] / p[2 * k + 1];
  }
};

}  // namespace

EffectRow describe_viscoelastic_creep() {
  EffectRow row{
      .id = "viscoelastic_creep",
      .coordinate = "lag",
      .site = Site::transmission,
      .equation = "tau += sum_i k_i s_i, s_i' = phi' - s_i/T_i (Maxwell branches)",
      .range = "small strains; time constants between the sampling and the recording",
      .not_modelled = "creep that is not linear in the load; dependence on temperature",
      .source = "Maxwell (1867); Flügge, Viscoelasticity (1975): branches beside a spring",
      .parameters = {{"stiffness", "Nm/rad", 0.0, 1e7, 4500.0,
                      "3 % of K1 = 1.5e5 Nm/rad of size 45, ratio 50"},
                     {"time_constant", "s", 1e-4, 1e5, 10.0,
                      "engineering judgement: 0.1 to 100 s"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
      .repeats = true,
      .states = 1};
  instantiate<ViscoelasticCreep>(row);
  return row;
}

}  // namespace flexspline
