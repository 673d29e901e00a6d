#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

struct TorqueSensorDrift {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    return p[0] * x.time + p[1] * relaxed(x.time / p[2]);
  }
};

}  // namespace

EffectRow describe_torque_sensor_drift() {
  EffectRow row{
      .id = "torque_sensor_drift",
      .coordinate = "time",
      .site = Site::torque_signal,
      .equation = "tau_measured = tau + r t + a (1 - exp(-t/T))",
      .range = "t >= 0 since the recording's clock started; slow against the excitation",
      .not_modelled = "a drift that follows a temperature up and down; a drift of the gain",
      .source = "data sheets of strain gauge bridges: 0.02 % of full scale per K",
      .parameters = {{"rate", "Nm/s", -1e3, 1e3, 2.5e-4, "0.45 Nm in half an hour"},
                     {"settling", "Nm", -1e5, 1e5, 0.45, "0.02 % of 226 Nm per K over 10 K"},
                     {"time_constant", "s", 1e-3, 1e6, 600.0, "warming of a housing"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen},
      .passive = false,
      .active_because = "an instrument: it shows what is not there, and does no work"};
  instantiate<TorqueSensorDrift>(row);
  return row;
}

}  // namespace flexspline
