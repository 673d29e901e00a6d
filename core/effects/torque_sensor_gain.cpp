#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

struct TorqueSensorGain {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    return p[0] * x.transmitted_torque;
  }
};

}  // namespace

EffectRow describe_torque_sensor_gain() {
  EffectRow row{.id = "torque_sensor_gain",
                .coordinate = "load",
                .site = Site::torque_signal,
                .equation = "tau_measured = (1 + e) tau",
                .range = "any torque; without a known load confounded with torque_constant_error",
                .not_modelled = "gains that differ between the directions",
                .source = "data sheets of torque sensors: 0.2 to 2 %",
                .parameters = {{"error", "1", -0.95, 20.0, 0.01, "1 % of the reading"}},
                .rigs = {Rig::locked, Rig::free, Rig::specimen},
                .passive = false,
                .active_because = "an instrument: it shows what is not there, and does no work",
                .rate_independent = true};
  instantiate<TorqueSensorGain>(row);
  return row;
}

}  // namespace flexspline
