#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// Parameters: share of the motor's torque, of the load's, widths of the sign and of the magnitude.
// The load pulls against the motor, so that the difference of M5 is a sum here.
struct DirectionalLoadFriction {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    const S load = x.transmitted_torque / x.gear_ratio;
    const S squeeze = p[0] * x.motor_torque + p[1] * load;
    return smooth_magnitude(squeeze, p[3]) * smooth_sign(x.motor_speed, p[2]);
  }
};

}  // namespace

EffectRow describe_directional_load_friction() {
  EffectRow row{
      .id = "directional_load_friction",
      .coordinate = "load",
      .site = Site::motor,
      .equation = "tau_f += |km tau_m + ke tau/N| tanh(w/we), |x| = sqrt(x^2 + te^2) - te",
      .range =
          "sliding, driving or back-driving; short of the magnitude by at most te; where the "
          "motor torque is a result, an implicit equation with one solution for km < 1",
      .not_modelled = "the Stribeck-weighted second pair of M5 (stribeck_load_friction)",
      .source = "Duclusaud, Passault, Padois, Ly, ICRA 2025 (BAM), model M5",
      .parameters = {{"motor_share", "1", 0.0, 0.9, 0.08, "BAM: 0.001 (eRob80:100), 0.2 (MX-106)"},
                     {"load_share", "1", 0.0, 2.0, 0.02, "BAM: 0.02 (MX-106)"},
                     {"smoothing", "rad/s", 1e-9, 100.0, 0.5, "0.2 to 1 rad/s at the motor"},
                     {"load_smoothing", "Nm", 1e-9, 1e3, 1e-3,
                      "a tenth of the friction at 0.2 % of rated torque / N"}},
      .rigs = {Rig::locked, Rig::free, Rig::servo}};
  instantiate<DirectionalLoadFriction>(row);
  return row;
}

}  // namespace flexspline
