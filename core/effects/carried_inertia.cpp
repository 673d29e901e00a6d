#include <cmath>

#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// Parameters (inertia, time constant) and the speed w of the inertia. Exact where the torsion rate
// is linear in time between two samples.
struct CarriedInertia {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S> z) {
    return p[0] / p[1] * (x.torsion_rate - z[0]);
  }

  template <class S>
  static void advance(const Instant<S>& from, const Instant<S>& to, std::span<const S> p,
                      std::span<S> z) {
    using std::exp;
    const S elapsed = (to.time - from.time) / p[1];
    const S left = exp(S(-elapsed));
    const S faster = to.torsion_rate - from.torsion_rate;
    z[0] = to.torsion_rate - (from.torsion_rate - z[0]) * left - faster * mean_left(elapsed);
  }

  template <class S>
  static void rate(const Instant<S>& x, std::span<const S> p, std::span<const S> z,
                   std::span<S> dz) {
    dz[0] = (x.torsion_rate - z[0]) / p[1];
  }
};

}  // namespace

EffectRow describe_carried_inertia() {
  EffectRow row{
      .id = "carried_inertia",
      .coordinate = "acceleration",
      .site = Site::transmission,
      .equation = "tau += J w', T w' = phi' - w (an inertia behind a dashpot J/T); w = 0 at first",
      .range = "one inertia on the side of a motion that is given; starts at rest",
      .not_modelled = "a spring beside the dashpot, with which it would swing",
      .source =
          "d'Alembert and a dashpot in series; Den Hartog, Mechanical Vibrations (1956), "
          "sec. 3.3: the dynamic absorber without spring",
      .parameters = {{"inertia", "kg m2", 0.0, 1e7, 1.815,
                      "N^2 (J_motor + J_wave_generator), Table II"},
                     {"time_constant", "s", 1e-4, 1e3, 0.05,
                      "engineering judgement: 0.01 to 0.1 s on a joint of a robot"}},
      .rigs = {Rig::specimen},
      .states = 1};
  instantiate<CarriedInertia>(row);
  return row;
}

}  // namespace flexspline
