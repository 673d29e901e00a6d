#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

struct MotorTorqueOffset {
  template <class S>
  static S term(const Instant<S>&, std::span<const S> p, std::span<const S>) {
    return p[0];
  }
};

}  // namespace

EffectRow describe_motor_torque_offset() {
  EffectRow row{.id = "motor_torque_offset",
                .coordinate = "constant",
                .site = Site::motor,
                .equation = "tau_f += o: recorded less true motor torque",
                .range = "an offset that does not change over the recordings",
                .not_modelled =
                    "separation from a friction that differs between the directions, its "
                    "confounded with it while moving",
                .source = "current sensors: 0.1 to 0.3 % of range",
                .parameters = {{"offset", "Nm", -1e6, 1e6, 5e-3, "1 to 10 mNm of 3.8 Nm",
                                linear("what is recorded of a motor without a torque")}},
                .rigs = {Rig::locked, Rig::free, Rig::servo},
                .passive = false,
                .active_because = "part of the motor, which drives"};
  instantiate<MotorTorqueOffset>(row);
  return row;
}

}  // namespace flexspline
