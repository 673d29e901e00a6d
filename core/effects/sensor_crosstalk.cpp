#include "flexspline/core/effect.hpp"
#include "harmonic.hpp"

namespace flexspline {
namespace {

struct SensorCrosstalk {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    return harmonics(x.motor_angle, p);
  }
};

}  // namespace

EffectRow describe_sensor_crosstalk() {
  EffectRow row{
      .id = "sensor_crosstalk",
      .coordinate = "motor_angle",
      .site = Site::torque_signal,
      .equation = "tau_measured = tau + sum_k a_k sin(k theta_m + p_k)",
      .range = "orders 2, 4 and 1 of the wave generator, without a motion behind them",
      .not_modelled = "axial and tilting loads on the sensor; amplitudes that depend on load",
      .source = "Hashimoto (1989); Taghirad, Helmy, Belanger (1998): gauges on the flexspline",
      .parameters = {{"amplitude", "Nm", 0.0, 1e5, 2.0, "1 % of 226 Nm; 0.5 to 3 % occur"},
                     {"order", "1", 0.01, 200.0, 2.0, "two lobes of the wave generator"},
                     {"phase", "rad", -3.2, 3.2, 0.0, "place of the gauges"}},
      .rigs = {Rig::locked, Rig::free},
      .repeats = true,
      .passive = false,
      .active_because = "an instrument: it shows what is not there, and does no work",
      .rate_independent = true};
  instantiate<SensorCrosstalk>(row);
  return row;
}

}  // namespace flexspline
