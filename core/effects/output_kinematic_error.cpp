#include "flexspline/core/effect.hpp"
#include "harmonic.hpp"

namespace flexspline {
namespace {

struct OutputKinematicError {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    return harmonics(x.load_angle, p);
  }
};

}  // namespace

EffectRow describe_output_kinematic_error() {
  EffectRow row{
      .id = "output_kinematic_error",
      .coordinate = "load_angle",
      .site = Site::kinematics,
      .equation = "phi = theta_m/N - theta_l + sum_m o_m sin(m theta_l + q_m)",
      .range = "orders of the output: 1 (pitch circle), 2 (ovality)",
      .not_modelled = "amplitudes that depend on load; work over a closed path of one angle alone",
      .source = "Ghorbel, Gandhi, Alpeter, J. Mech. Des. 123(1), 2001",
      .parameters = {{"amplitude", "rad", 0.0, 0.1, 1e-4,
                      "engineering judgement: order 1: 0.05 to 0.2 mrad"},
                     {"order", "1", 0.01, 1000.0, 1.0, "one turn of the output"},
                     {"phase", "rad", -3.2, 3.2, 0.0, "depends on the assembly"}},
      .rigs = {Rig::free, Rig::servo},
      .repeats = true,
      .passive = false,
      .active_because =
          "it has work on its two shafts: passive with the torque tau do/dtheta_l that it returns "
          "to the load, as the free rig models it",
      .rate_independent = true};
  instantiate<OutputKinematicError>(row);
  return row;
}

}  // namespace flexspline
