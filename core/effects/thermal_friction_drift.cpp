#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// Parameters: Coulomb torque and viscous coefficient lost on warming up, time constant, width.
struct ThermalDrift {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    using std::exp;
    const S cold = exp(-x.time / p[2]);
    return cold * (p[0] * smooth_sign(x.motor_speed, p[3]) + p[1] * x.motor_speed);
  }
};

}  // namespace

EffectRow describe_thermal_friction_drift() {
  EffectRow row{
      .id = "thermal_friction_drift",
      .coordinate = "time",
      .site = Site::motor,
      .equation = "tau_f += (tc tanh(w/we) + B w) exp(-t/T), t = time of the recording from 0",
      .range =
          "a recording of steady duty that starts cold at t = 0; the warm friction is the "
          "baseline's",
      .not_modelled = "heat that follows the duty (thermal_state); recordings that start warm",
      .source = "Simoni, Beschi, Legnani, Visioli, Robotica 2017; Wolf and Iskandar, ICRA 2018",
      .parameters = {{"coulomb", "Nm", 0.0, 1e6, 0.03, "friction falls by 30 to 60 % from cold"},
                     {"viscous", "Nm s/rad", 0.0, 1e6, 4e-4,
                      "viscosity halves in 20 K; Coulomb friction falls less"},
                     {"time_constant", "s", 0.1, 1e6, 1800.0,
                      "600 to 3000 s; Compliant Joint Toolbox's motor: 1814 s"},
                     {"smoothing", "rad/s", 1e-9, 100.0, 0.5, "0.2 to 1 rad/s at the motor"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo}};
  instantiate<ThermalDrift>(row);
  return row;
}

}  // namespace flexspline
