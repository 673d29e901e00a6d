#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// Parameters (stiffness, yield) and the state s of every element. A stop operator is exact along a
// monotone piece of the path.
struct MaxwellSlip {
  template <class S>
  static S term(const Instant<S>&, std::span<const S> p, std::span<const S> z) {
    S sum(0.0);
    for (std::size_t k = 0; k < z.size(); ++k) sum += p[2 * k] * z[k];
    return sum;
  }

  template <class S>
  static void advance(const Instant<S>& from, const Instant<S>& to, std::span<const S> p,
                      std::span<S> z) {
    const S step = to.torsion - from.torsion;
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = limited(z[k] + step, p[2 * k + 1]);
  }

  template <class S>
  static void rate(const Instant<S>& x, std::span<const S> p, std::span<const S> z,
                   std::span<S> dz) {
    for (std::size_t k = 0; k < z.size(); ++k) {
      dz[k] = stop_rate(z[k], x.torsion_rate, p[2 * k + 1]);
    }
  }
};

}  // namespace

EffectRow describe_presliding_hysteresis() {
  EffectRow row{
      .id = "presliding_hysteresis",
      .coordinate = "reversal_memory",
      .site = Site::transmission,
      .equation = "tau += sum_i k_i s_i, s_i' = phi' unless |s_i| = r_i (Maxwell slip)",
      .range = "any motion; starts unloaded",
      .not_modelled = "drift under a held load; dependence of the yields on load or temperature",
      .source = "Iwan (1966); Tjahjowidodo, Al-Bender, Van Brussel, Mechatronics 23(5), 2013",
      .parameters = {{"stiffness", "Nm/rad", 0.0, 1e9, 1000.0,
                      "Table I read as rate-independent: half height 4.5 Nm"},
                     {"yield", "rad", 1e-7, 0.1, 3e-4,
                      "catalogue hysteresis of ratio 50: 2 arcmin"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
      .repeats = true,
      .states = 1,
      .rate_independent = true};
  instantiate<MaxwellSlip>(row);
  return row;
}

}  // namespace flexspline
