#include "quantised.hpp"

namespace flexspline {

EffectRow describe_torque_quantisation() {
  return quantisation({.id = "torque_quantisation",
                       .coordinate = "load",
                       .site = Site::torque_signal,
                       .equation = "tau_measured = q round(tau/q)",
                       .range = kQuantisedRange,
                       .not_modelled = kQuantisedNotModelled,
                       .source = "analogue to digital converters: full scale/2^n",
                       .parameters = {{"step", "Nm", 0.0, 1e5, 0.015, "16 bits over +-500 Nm"}},
                       .rigs = {Rig::locked, Rig::free, Rig::specimen}});
}

}  // namespace flexspline
