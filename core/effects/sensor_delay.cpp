#include "delayed.hpp"
#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// To first order, for derivatives at an instant; signals are mapped exactly.
struct SensorDelay {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    return -p[0] * x.transmitted_torque_rate;
  }
};

void map(std::span<const double> time, std::span<double> signal,
         std::span<const double> parameters) {
  delay_signal(time, signal, parameters[0]);
}

}  // namespace

EffectRow describe_sensor_delay() {
  EffectRow row{
      .id = "sensor_delay",
      .coordinate = "lag",
      .site = Site::torque_signal,
      .equation = "tau_measured(t) = tau(t - d)",
      .range = "|d| well below a period of the excitation",
      .not_modelled =
          "filters whose delay depends on frequency; the motion that a delayed torque made, "
          "which needs the whole signal",
      .source = "anti-alias filters and bus cycles: 0.5 to 5 ms",
      .parameters = {{"delay", "s", -10.0, 10.0, 1e-3, "anti-alias filters"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen},
      .passive = false,
      .active_because = "an instrument: it shows what is not there, and does no work"};
  instantiate<SensorDelay>(row);
  row.map = map;
  return row;
}

}  // namespace flexspline
