#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

struct TorqueSensorOffset {
  template <class S>
  static S term(const Instant<S>&, std::span<const S> p, std::span<const S>) {
    return p[0];
  }
};

}  // namespace

EffectRow describe_torque_sensor_offset() {
  EffectRow row{.id = "torque_sensor_offset",
                .coordinate = "constant",
                .site = Site::torque_signal,
                .equation = "tau_measured = tau + o",
                .range = "an offset that does not change over the recordings",
                .not_modelled = "drift of the offset",
                .source = "data sheets of torque sensors: 0.1 to 0.5 % of full scale",
                .parameters = {{"offset", "Nm", -1e6, 1e6, 0.5, "0.2 % of 226 Nm",
                                linear("what the torque sensor reads without a torque")}},
                .rigs = {Rig::locked, Rig::free, Rig::specimen},
                .sought_on = {Rig::locked, Rig::free},
                .rate_independent = true};
  instantiate<TorqueSensorOffset>(row);
  return row;
}

}  // namespace flexspline
