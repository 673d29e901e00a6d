#include "flexspline/core/effect.hpp"
#include "harmonic.hpp"

namespace flexspline {
namespace {

struct KinematicError {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    return harmonics(x.motor_angle, p);
  }
};

}  // namespace

EffectRow describe_kinematic_error() {
  EffectRow row{
      .id = "kinematic_error",
      .coordinate = "motor_angle",
      .site = Site::kinematics,
      .equation = "phi = theta_m/N - theta_l + sum_k e_k sin(k theta_m + p_k)",
      .range =
          "orders of the wave generator: 2 (lobes on the circular spline), 4, 1 "
          "(eccentricity) and 2 (1 + 1/N) = 2.04 at ratio 50 (lobes on the flexspline)",
      .not_modelled = "amplitudes that depend on load; work over a closed path of one angle alone",
      .source = "Ghorbel, Gandhi, Alpeter, J. Mech. Des. 123(1), 2001; Jia et al., MMT 155, 2021",
      .parameters = {{"amplitude", "rad", 0.0, 0.1, 1.5e-4,
                      "catalogue accuracy of 1 arcmin; order 2: 0.05 to 0.3 mrad"},
                     {"order", "1", 0.01, 200.0, 2.0, "two lobes of the wave generator"},
                     {"phase", "rad", -3.2, 3.2, 0.0, "depends on the assembly"}},
      .rigs = {Rig::locked, Rig::free, Rig::servo},
      .repeats = true,
      .passive = false,
      .active_because =
          "it has work on its two shafts: passive with the torque tau de/dtheta_m that it returns "
          "to the motor, as the rigs model it",
      .rate_independent = true};
  instantiate<KinematicError>(row);
  return row;
}

}  // namespace flexspline
