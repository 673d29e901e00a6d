#include "quantised.hpp"

namespace flexspline {

EffectRow describe_motor_encoder_quantisation() {
  EffectRow row{
      .id = "motor_encoder_quantisation",
      .coordinate = "motor_angle",
      .site = Site::motor_angle_signal,
      .equation = "theta_m,measured = q round(theta_m/q)",
      .range = "any angle; as white noise of q/sqrt(12) where the signal crosses many steps",
      .not_modelled = "steps of unequal width; at an instant it counts as its mean, 0",
      .source = "2 pi/2^n for an encoder of n bits",
      .parameters = {{"step", "rad", 0.0, 1.0, 7.7e-4, "13 bits: 2 pi/2^13"}},
      .rigs = {Rig::locked, Rig::free},
      .passive = false,
      .rate_independent = true};
  instantiate<MeanOfQuantisation>(row);
  row.map = quantise_signal;
  return row;
}

}  // namespace flexspline
