#include <cmath>

#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

struct LostMotion {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    using std::sqrt;
    const S& tau = x.transmitted_torque;
    return -p[0] * tau / sqrt(tau * tau + p[1] * p[1]);
  }
};

}  // namespace

EffectRow describe_lost_motion() {
  EffectRow row{
      .id = "lost_motion",
      .coordinate = "torsion",
      .site = Site::kinematics,
      .equation = "phi_e = phi - b tau/sqrt(tau^2 + t^2)",
      .range = "any torque; the gap 2b is crossed while the torque changes its sign, over t",
      .not_modelled =
          "friction within the gap, which makes the crossing a matter of memory (play_backlash); "
          "impacts where the flanks meet",
      .source = "lost motion of gear catalogues: the torsion between small torques either way",
      .parameters = {{"half_gap", "rad", 0.0, 0.2, 1e-4, "Oldham coupling: 5 to 30 arcsec"},
                     {"width", "Nm", 1e-9, 1e5, 9.0, "catalogues measure at +-3 to 4 % of rated"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen},
      .rate_independent = true};
  instantiate<LostMotion>(row);
  return row;
}

}  // namespace flexspline
