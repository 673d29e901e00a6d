#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

struct TorsionZero {
  template <class S>
  static S term(const Instant<S>&, std::span<const S> p, std::span<const S>) {
    return -p[0];
  }
};

}  // namespace

EffectRow describe_torsion_zero() {
  EffectRow row{.id = "torsion_zero",
                .coordinate = "constant",
                .site = Site::kinematics,
                .equation = "phi_e = phi - o: unloaded at phi = o",
                .range = "a zero that does not change over the recordings",
                .not_modelled = "a zero that moves from one recording to the next",
                .source = "encoders read from where they were switched on",
                .parameters = {{"zero", "rad", -100.0, 100.0, 1e-4, "a tenth of the windup"}},
                .rigs = {Rig::locked, Rig::free, Rig::specimen},
                .passive = false,
                .active_because =
                    "a datum: it moves where the spring is unloaded, not silent at "
                    "rest, but makes no energy over a cycle",
                .rate_independent = true};
  instantiate<TorsionZero>(row);
  return row;
}

}  // namespace flexspline
