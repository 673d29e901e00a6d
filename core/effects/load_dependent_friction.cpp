#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// Parameters: coefficient, width of the sign of speed, width of the magnitude of torque.
struct LoadFriction {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    const S load = smooth_magnitude(x.transmitted_torque, p[2]) / x.gear_ratio;
    return p[0] * load * smooth_sign(x.motor_speed, p[1]);
  }
};

}  // namespace

EffectRow describe_load_dependent_friction() {
  EffectRow row{
      .id = "load_dependent_friction",
      .coordinate = "load",
      .site = Site::motor,
      .equation = "tau_f += mu |tau|/N tanh(w/we), |tau| = sqrt(tau^2 + te^2) - te",
      .range = "sliding under up to rated torque; short of |tau| by at most te",
      .not_modelled = "difference between driving and back-driving; growth faster than the load",
      .source = "Hamon, Gautier, Garrec, IROS 2010; Bittencourt et al., IROS 2010; BAM model M3",
      .parameters = {{"coefficient", "1", 0.0, 2.0, 0.06,
                      "BAM: 0.034 to 0.085 (eRob80:50), 0.15 (eRob80:100)"},
                     {"smoothing", "rad/s", 1e-9, 100.0, 0.5, "0.2 to 1 rad/s at the motor"},
                     {"load_smoothing", "Nm", 1e-9, 1e3, 0.5,
                      "0.2 % of 226 Nm, the sensor's zero"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo}};
  instantiate<LoadFriction>(row);
  return row;
}

}  // namespace flexspline
