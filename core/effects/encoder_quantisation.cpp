#include "quantised.hpp"

namespace flexspline {

EffectRow describe_encoder_quantisation() {
  return quantisation({.id = "encoder_quantisation",
                       .coordinate = "load_angle",
                       .site = Site::load_angle_signal,
                       .equation = "theta_l,measured = q round(theta_l/q)",
                       .range = kQuantisedRange,
                       .not_modelled = kQuantisedNotModelled,
                       .source = "2 pi/2^n for an encoder of n bits",
                       .parameters = {{"step", "rad", 0.0, 0.1, 1.2e-5, "19 bits: 2 pi/2^19"}},
                       .rigs = {Rig::free, Rig::servo}});
}

}  // namespace flexspline
