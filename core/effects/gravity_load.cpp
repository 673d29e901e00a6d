#include <cmath>

#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

struct GravityLoad {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    using std::sin;
    return p[0] * sin(x.load_angle + p[1]);
  }
};

}  // namespace

EffectRow describe_gravity_load() {
  EffectRow row{
      .id = "gravity_load",
      .coordinate = "load_angle",
      .site = Site::load,
      .equation = "tau_l += m g l sin(theta_l + a)",
      .range = "any angle; a = 0 hangs at theta_l = 0",
      .not_modelled = "centrifugal terms; the inertia of the mass, which is J_l's",
      .source = "statics of an eccentric mass on a horizontal shaft",
      .parameters = {{"moment", "Nm", 0.0, 1e6, 11.0, "5 % of 226 Nm; 1 to 20 % occur",
                      linear("of the torque that goes with the sine of the load angle")},
                     {"phase", "rad", -3.2, 3.2, 0.0, "zero of the load's encoder", phase()}},
      .rigs = {Rig::free, Rig::servo},
      .sought_on = {Rig::free},
      .rate_independent = true};
  instantiate<GravityLoad>(row);
  return row;
}

}  // namespace flexspline
