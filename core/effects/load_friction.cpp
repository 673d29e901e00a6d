#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

struct LoadFriction {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    return p[0] * smooth_sign(x.load_speed, p[2]) + p[1] * x.load_speed;
  }
};

}  // namespace

EffectRow describe_load_friction() {
  EffectRow row{
      .id = "load_friction",
      .coordinate = "velocity",
      .site = Site::load,
      .equation = "tau_l += C tanh(w_l/w_0) + B w_l",
      .range = "output bearing and seals; creeps instead of sticking below w_0",
      .not_modelled = "stiction; growth with the tilting moment on the bearing",
      .source = "cross roller bearings and seals: 0.5 to 3 Nm (engineering judgement)",
      .parameters = {{"coulomb", "Nm", 0.0, 1e5, 1.5, "0.7 % of 226 Nm"},
                     {"viscous", "Nm s/rad", 0.0, 1e5, 1.0, "N = 50 actuators: 1.2 to 1.6"},
                     {"width", "rad/s", 1e-6, 10.0, 0.01, "0.5 rad/s at the motor"}},
      .rigs = {Rig::free, Rig::servo}};
  instantiate<LoadFriction>(row);
  return row;
}

}  // namespace flexspline
