#include "quantised.hpp"

namespace flexspline {

EffectRow describe_torque_quantisation() {
  EffectRow row{
      .id = "torque_quantisation",
      .coordinate = "load",
      .site = Site::torque_signal,
      .equation = "tau_measured = q round(tau/q)",
      .range = "any torque; as white noise of q/sqrt(12) where the signal crosses many steps",
      .not_modelled = "steps of unequal width; at an instant it counts as its mean, 0",
      .source = "analogue to digital converters: full scale/2^n",
      .parameters = {{"step", "Nm", 0.0, 1e5, 0.015, "16 bits over +-500 Nm"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen},
      .passive = false,
      .rate_independent = true};
  instantiate<MeanOfQuantisation>(row);
  row.map = quantise_signal;
  return row;
}

}  // namespace flexspline
