#include "flexspline/core/effect.hpp"
#include "harmonic.hpp"

namespace flexspline {
namespace {

struct LoadDependentKinematicError {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    return x.transmitted_torque * harmonics(x.motor_angle, p);
  }
};

}  // namespace

EffectRow describe_load_dependent_kinematic_error() {
  EffectRow row{
      .id = "load_dependent_kinematic_error",
      .coordinate = "motor_angle",
      .site = Site::kinematics,
      .equation = "phi = theta_m/N - theta_l + tau sum_k c_k sin(k theta_m + p_k)",
      .range = "the part of the kinematic error that grows with load; orders of the wave generator",
      .not_modelled = "the part without load (kinematic_error); growth that is not linear in load",
      .source = "Ghorbel, Gandhi, Alpeter, J. Mech. Des. 123(1), 2001: part due to flexibility",
      .parameters = {{"compliance", "rad/Nm", 0.0, 1.0, 3e-7,
                      "half of an error of 0.15 mrad at 226 Nm"},
                     {"order", "1", 0.01, 200.0, 2.0, "two lobes of the wave generator"},
                     {"phase", "rad", -3.2, 3.2, 0.0, "depends on the assembly"}},
      .rigs = {Rig::locked, Rig::free},
      .repeats = true,
      .passive = false,
      .active_because =
          "a compliance that turns with the motor: passive beside a series compliance of at least "
          "its own and with the torque tau^2/2 dc/dtheta_m that it returns to the motor",
      .rate_independent = true};
  instantiate<LoadDependentKinematicError>(row);
  return row;
}

}  // namespace flexspline
