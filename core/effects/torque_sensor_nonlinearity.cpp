#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// The state is that of a stop operator over the torque, in Nm of torque.
struct TorqueSensorNonlinearity {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S> z) {
    const S& tau = x.transmitted_torque;
    const S cubic = p[0] * (tau * (tau * tau));
    return cubic + p[1] * z[0] / p[2];
  }

  template <class S>
  static void advance(const Instant<S>& from, const Instant<S>& to, std::span<const S> p,
                      std::span<S> z) {
    z[0] = limited(z[0] + (to.transmitted_torque - from.transmitted_torque), p[2]);
  }

  template <class S>
  static void rate(const Instant<S>& x, std::span<const S> p, std::span<const S> z,
                   std::span<S> dz) {
    dz[0] = stop_rate(z[0], x.transmitted_torque_rate, p[2]);
  }
};

}  // namespace

EffectRow describe_torque_sensor_nonlinearity() {
  EffectRow row{
      .id = "torque_sensor_nonlinearity",
      .coordinate = "load",
      .site = Site::torque_signal,
      .equation = "tau_measured = tau + c tau^3 + H s/T, s' = tau' unless |s| = T",
      .range = "within the sensor's full scale; its hysteresis starts unloaded",
      .not_modelled = "an even part; hysteresis of more than one width",
      .source = "data sheets of torque sensors: 0.05 to 0.3 % of full scale, rate-independent",
      .parameters = {{"cubic", "1/Nm2", -1.0, 1.0, 2e-8, "0.1 % of full scale at 226 Nm"},
                     {"hysteresis", "Nm", 0.0, 1e4, 0.2, "0.1 % of 226 Nm, half height"},
                     {"width", "Nm", 1e-6, 1e5, 20.0, "torque after a reversal until it is full"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen},
      .states = 1,
      .passive = false,
      .active_because = "an instrument: it shows what is not there, and does no work",
      .rate_independent = true};
  instantiate<TorqueSensorNonlinearity>(row);
  return row;
}

}  // namespace flexspline
