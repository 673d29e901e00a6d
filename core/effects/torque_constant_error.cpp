#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

struct TorqueConstantError {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    return -p[0] * x.motor_torque;
  }
};

}  // namespace

EffectRow describe_torque_constant_error() {
  EffectRow row{.id = "torque_constant_error",
                .coordinate = "load",
                .site = Site::motor,
                .equation = "tau_f -= e tau_m: true torque = (1 + e) recorded, recorded = kt i",
                .range = "any current; where the motor torque is a result, tau_m = rest / (1 + e)",
                .not_modelled =
                    "loss of kt with the magnets' temperature; separation from a gain of the "
                    "torque sensor without a known load",
                .source = "data sheets of motors: kt to 3 to 10 %",
                .parameters = {{"error", "1", -0.5, 0.5, 0.05, "3 to 7 % seen"}},
                .rigs = {Rig::locked, Rig::free, Rig::servo},
                .passive = false,
                .active_because = "part of the motor, which drives"};
  instantiate<TorqueConstantError>(row);
  return row;
}

}  // namespace flexspline
