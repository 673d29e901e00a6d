#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

struct InertiaTorque {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    return p[0] * x.torsion_acceleration;
  }
};

}  // namespace

EffectRow describe_inertia_torque() {
  EffectRow row{.id = "inertia_torque",
                .coordinate = "acceleration",
                .site = Site::torque_signal,
                .equation = "tau_measured = tau + J phi''",
                .range = "inertia between the torsion and the torque sensor, rigid with the motion",
                .not_modelled =
                    "an inertia that moves with another shaft than the motion measured; the "
                    "motion that a torque makes through it, which needs the acceleration",
                .source = "d'Alembert; N^2 (J_motor + J_wave_generator) of Table II as a scale",
                .parameters = {{"inertia", "kg m2", -1e7, 1e7, 1.815,
                                "N^2 (J_motor + J_wave_generator), Table II"}},
                .rigs = {Rig::locked, Rig::specimen}};
  instantiate<InertiaTorque>(row);
  return row;
}

}  // namespace flexspline
