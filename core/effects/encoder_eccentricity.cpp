#include <cmath>

#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

struct EncoderEccentricity {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    using std::sin;
    return p[0] * sin(x.load_angle + p[1]);
  }
};

}  // namespace

EffectRow describe_encoder_eccentricity() {
  EffectRow row{.id = "encoder_eccentricity",
                .coordinate = "load_angle",
                .site = Site::load_angle_signal,
                .equation = "theta_l,measured = theta_l + a sin(theta_l + p)",
                .range = "any angle; order 1 of the output's encoder, with no torque behind it",
                .not_modelled = "interpolation errors of the line order",
                .source = "a disc of radius R off centre by e reads e/R too much: 0.05 to 0.2 mrad",
                .parameters = {{"amplitude", "rad", 0.0, 0.1, 1e-4, "3 um at a radius of 30 mm"},
                               {"phase", "rad", -3.2, 3.2, 0.0, "depends on the assembly"}},
                .rigs = {Rig::free, Rig::servo},
                .passive = false,
                .active_because = "an instrument: it shows what is not there, and does no work",
                .rate_independent = true};
  instantiate<EncoderEccentricity>(row);
  return row;
}

}  // namespace flexspline
