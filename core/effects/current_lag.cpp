#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// One state: how far the true torque is behind the reference. It starts settled.
struct CurrentLag {
  template <class S>
  static S term(const Instant<S>&, std::span<const S>, std::span<const S> z) {
    return z[0];
  }

  // Exact for a reference that is straight between the samples.
  template <class S>
  static void advance(const Instant<S>& from, const Instant<S>& to, std::span<const S> p,
                      std::span<S> z) {
    const S elapsed = (to.time - from.time) / p[0];
    const S change = to.motor_torque - from.motor_torque;
    z[0] += change * mean_left(elapsed) - z[0] * relaxed(elapsed);
  }

  template <class S>
  static void rate(const Instant<S>& x, std::span<const S> p, std::span<const S> z,
                   std::span<S> dz) {
    dz[0] = x.motor_torque_rate - z[0] / p[0];
  }
};

}  // namespace

EffectRow describe_current_lag() {
  EffectRow row{
      .id = "current_lag",
      .coordinate = "lag",
      .site = Site::motor,
      .equation =
          "tau_f += q, q' = tau_m' - q/Ti: the true torque tau_m - q follows the reference "
          "tau_m as Ti (tau_m - q)' = q",
      .range = "the motor torque recorded is the reference of the current loop; starts settled",
      .not_modelled = "a loop of higher order; voltage limits; delay of the command",
      .source = "bandwidth of current loops: 50 to 500 Hz",
      .parameters = {{"time_constant", "s", 1e-7, 1.0, 1e-3, "0.3 to 3 ms"}},
      .rigs = {Rig::locked, Rig::free, Rig::servo},
      .states = 1,
      .passive = false,
      .active_because =
          "part of the motor, which drives: the torque that the winding has not yet taken back"};
  instantiate<CurrentLag>(row);
  return row;
}

}  // namespace flexspline
