#include "flexspline/core/effect.hpp"
#include "harmonic.hpp"

namespace flexspline {
namespace {

struct StiffnessRipple {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    return x.torsion * harmonics(x.motor_angle, p);
  }
};

}  // namespace

EffectRow describe_stiffness_ripple() {
  EffectRow row{
      .id = "stiffness_ripple",
      .coordinate = "motor_angle",
      .site = Site::transmission,
      .equation = "tau += phi sum_k D_k sin(k theta_m + p_k): K (1 + eps sin 2 theta_m), D = eps K",
      .range = "ripple well below the law's own stiffness; orders of the wave generator",
      .not_modelled = "a ripple of the law's curvature",
      .source = "radial compliance of the wave generator; engineering judgement: eps 1 to 3 %",
      .parameters = {{"stiffness", "Nm/rad", 0.0, 1e6, 3000.0,
                      "2 % of K1 = 1.5e5 Nm/rad of size 45, ratio 50",
                      linear("of the stiffness that goes with the sine of the motor's turns")},
                     {"order", "1", 0.01, 200.0, 2.0, "two lobes of the wave generator", held()},
                     {"phase", "rad", -3.2, 3.2, 0.0, "depends on the assembly", phase()}},
      .rigs = {Rig::locked, Rig::free, Rig::servo},
      .sought_on = {Rig::free},
      .repeats = true,
      .passive = false,
      .active_because =
          "it has work on its two shafts: passive with the torque phi^2/2 dD/dtheta_m that it "
          "returns to the motor, as the rigs model it",
      .rate_independent = true};
  instantiate<StiffnessRipple>(row);
  return row;
}

}  // namespace flexspline
