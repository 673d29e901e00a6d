#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// Parameters: coefficient at rest, Stribeck speed, exponent, widths of the sign of speed and of the
// magnitude of torque.
struct StribeckLoadFriction {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    using std::exp;
    const S load = smooth_magnitude(x.transmitted_torque, p[4]) / x.gear_ratio;
    const S left = exp(-positive_power(S(magnitude(x.motor_speed) / p[1]), p[2]));
    return p[0] * load * left * smooth_sign(x.motor_speed, p[3]);
  }
};

}  // namespace

EffectRow describe_stribeck_load_friction() {
  EffectRow row{
      .id = "stribeck_load_friction",
      .coordinate = "load",
      .site = Site::motor,
      .equation =
          "tau_f += mu_s |tau|/N exp(-|w/ws|^d) tanh(w/we), |tau| = sqrt(tau^2 + te^2) - te",
      .range =
          "sliding under up to rated torque; short of |tau| by at most te; beside "
          "load_dependent_friction, whose coefficient it adds to near rest",
      .not_modelled = "difference between driving and back-driving; dependence on the time at rest",
      .source = "Duclusaud, Passault, Padois, Ly, ICRA 2025 (BAM), model M4",
      .parameters = {{"coefficient", "1", 0.0, 2.0, 0.02,
                      "a third of load_dependent_friction (judgement); BAM's bound: 1"},
                     {"stribeck_speed", "rad/s", 1e-6, 1e4, 10.0, "1 to 30 rad/s at the motor"},
                     {"exponent", "1", 0.5, 4.0, 2.0,
                      "Armstrong-Helouvry et al. (1994): 0.5 to 2; BAM fits up to 3"},
                     {"smoothing", "rad/s", 1e-9, 100.0, 0.5, "0.2 to 1 rad/s at the motor"},
                     {"load_smoothing", "Nm", 1e-9, 1e3, 0.5,
                      "0.2 % of 226 Nm, the sensor's zero"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo}};
  instantiate<StribeckLoadFriction>(row);
  return row;
}

}  // namespace flexspline
