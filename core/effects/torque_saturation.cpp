#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

struct TorqueSaturation {
  // Held at the summit of the cubic, so that torque never falls as the current rises.
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    using std::sqrt;
    const S& torque = x.motor_torque;
    const S square = 3.0 * p[0] * torque * torque;
    const S summit = 2.0 / (3.0 * sqrt(3.0 * p[0]));
    const S held = where_negative(torque, S(torque + summit), S(torque - summit));
    return where_negative(S(square - 1.0), S(p[0] * torque * torque * torque), held);
  }
};

}  // namespace

EffectRow describe_torque_saturation() {
  EffectRow row{
      .id = "torque_saturation",
      .coordinate = "load",
      .site = Site::motor,
      .equation =
          "true torque = tau_m (1 - s tau_m^2), s = c/tau_peak^2 for kt (1 - c (i/i_peak)^2); "
          "tau_f += recorded less true",
      .range = "3 s tau_m^2 < 1; beyond, the true torque stays at its summit 2/(3 sqrt(3 s))",
      .not_modelled = "field weakening; the ceiling that falls with speed at the bus voltage",
      .source = "Hanselman (2003); data sheets of motors: 2 to 15 % lost at peak current",
      .parameters = {{"softening", "1/Nm2", 0.0, 1e6, 4.6e-4, "6 % at three times 3.8 Nm"}},
      .rigs = {Rig::locked, Rig::free, Rig::servo},
      .passive = false,
      .active_because = "part of the motor, which drives"};
  instantiate<TorqueSaturation>(row);
  return row;
}

}  // namespace flexspline
