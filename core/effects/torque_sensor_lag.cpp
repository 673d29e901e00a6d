#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// To first order, for derivatives at an instant; signals are mapped.
struct TorqueSensorLag {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    return -p[0] * x.transmitted_torque_rate;
  }
};

// Exact for a torque that is straight between the samples. State: how far the reading is behind.
void map(std::span<const double> time, std::span<double> signal,
         std::span<const double> parameters) {
  const double time_constant = parameters[0];
  if (!(time_constant > 0.0) || signal.empty()) return;
  double behind = 0.0;
  double before = signal.front();
  for (std::size_t i = 1; i < signal.size(); ++i) {
    const double elapsed = (time[i] - time[i - 1]) / time_constant;
    const double now = signal[i];
    behind += (now - before) * mean_left(elapsed) - behind * relaxed(elapsed);
    before = now;
    signal[i] = now - behind;
  }
}

}  // namespace

EffectRow describe_torque_sensor_lag() {
  EffectRow row{
      .id = "torque_sensor_lag",
      .coordinate = "lag",
      .site = Site::torque_signal,
      .equation = "T tau_measured' = tau - tau_measured, tau_measured = tau at the first sample",
      .range = "filters of one dominant pole; starts settled; torque straight between samples",
      .not_modelled =
          "filters of higher order, dead time (sensor_delay); the motion that a lagging torque "
          "made, which needs the whole signal",
      .source = "Oppenheim, Willsky, Signals and Systems (1997), sec. 6.5: first-order low-pass",
      .parameters = {{"time_constant", "s", 0.0, 10.0, 1.6e-3,
                      "1/(2 pi 100 Hz), an amplifier's filter; 0.1 ms to 0.1 s occur"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen},
      .passive = false,
      .active_because = "an instrument: it shows what is not there, and does no work"};
  instantiate<TorqueSensorLag>(row);
  row.map = map;
  return row;
}

}  // namespace flexspline
