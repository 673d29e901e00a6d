#include <cmath>

#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// Lost is b ([|x + b|] - [|x - b|]) / 2b with rounded magnitudes r = sqrt(.^2 + w^2), written as a
// quotient that has no cancellation.
struct Backlash {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    return -lost(x.torsion, p[0], p[1]);
  }

  template <class S>
  static S lost(const S& x, const S& b, const S& width) {
    const S sum = rounded(x + b, width) + rounded(x - b, width);
    return 2.0 * (x * b) / sum;
  }

  template <class S>
  static S rounded(const S& x, const S& width) {
    using std::sqrt;
    return sqrt(x * x + width * width);
  }
};

}  // namespace

EffectRow describe_backlash() {
  EffectRow row{
      .id = "backlash",
      .coordinate = "torsion",
      .site = Site::kinematics,
      .equation = "phi_e = phi - (sqrt((phi + b)^2 + w^2) - sqrt((phi - b)^2 + w^2))/2",
      .range = "any torsion; phi_e is 0 within +-b and phi -+ b beyond, rounded over w",
      .not_modelled = "impacts at the ends of the gap; friction that holds it open (play_backlash)",
      .source = "Nordin, Gutman, Automatica 38(10), 2002: dead zone of a shaft with backlash",
      .parameters = {{"half_gap", "rad", 0.0, 0.2, 1e-4, "Oldham coupling: 5 to 30 arcsec"},
                     {"rounding", "rad", 1e-9, 0.02, 2e-5, "a fifth of the half gap"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
      .rate_independent = true};
  instantiate<Backlash>(row);
  return row;
}

}  // namespace flexspline
