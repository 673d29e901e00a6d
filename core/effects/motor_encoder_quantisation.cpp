#include "quantised.hpp"

namespace flexspline {

EffectRow describe_motor_encoder_quantisation() {
  return quantisation({.id = "motor_encoder_quantisation",
                       .coordinate = "motor_angle",
                       .site = Site::motor_angle_signal,
                       .equation = "theta_m,measured = q round(theta_m/q)",
                       .range = kQuantisedRange,
                       .not_modelled = kQuantisedNotModelled,
                       .source = "2 pi/2^n for an encoder of n bits",
                       .parameters = {{"step", "rad", 0.0, 1.0, 7.7e-4, "13 bits: 2 pi/2^13"}},
                       .rigs = {Rig::locked, Rig::free}});
}

}  // namespace flexspline
