#include "quantised.hpp"

namespace flexspline {

EffectRow describe_encoder_quantisation() {
  EffectRow row{
      .id = "encoder_quantisation",
      .coordinate = "load_angle",
      .site = Site::load_angle_signal,
      .equation = "theta_l,measured = q round(theta_l/q)",
      .range = "any angle; as white noise of q/sqrt(12) where the signal crosses many steps",
      .not_modelled = "steps of unequal width; at an instant it counts as its mean, 0",
      .source = "2 pi/2^n for an encoder of n bits",
      .parameters = {{"step", "rad", 0.0, 0.1, 1.2e-5, "19 bits: 2 pi/2^19"}},
      .rigs = {Rig::free, Rig::servo},
      .passive = false,
      .rate_independent = true};
  instantiate<MeanOfQuantisation>(row);
  row.map = quantise_signal;
  return row;
}

}  // namespace flexspline
