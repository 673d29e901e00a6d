#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

constexpr std::size_t kGroup = 3;

// Parameters of an element: coefficient, yield, width of the magnitude of torque. State of an
// element: its deflection at the output. A stop operator is exact along a monotone piece of the
// path.
struct PreslidingLoadFriction {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S> z) {
    S sum(0.0);
    for (std::size_t k = 0; k < z.size(); ++k) {
      const auto own = p.subspan(k * kGroup, kGroup);
      sum += own[0] * smooth_magnitude(x.transmitted_torque, own[2]) * z[k] / own[1];
    }
    return sum / x.gear_ratio;
  }

  template <class S>
  static void advance(const Instant<S>& from, const Instant<S>& to, std::span<const S> p,
                      std::span<S> z) {
    const S step = (to.motor_angle - from.motor_angle) / to.gear_ratio;
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = limited(z[k] + step, p[k * kGroup + 1]);
  }

  template <class S>
  static void rate(const Instant<S>& x, std::span<const S> p, std::span<const S> z,
                   std::span<S> dz) {
    const S speed = x.motor_speed / x.gear_ratio;
    for (std::size_t k = 0; k < z.size(); ++k) dz[k] = stop_rate(z[k], speed, p[k * kGroup + 1]);
  }
};

}  // namespace

EffectRow describe_presliding_load_friction() {
  EffectRow row{
      .id = "presliding_load_friction",
      .coordinate = "load",
      .site = Site::motor,
      .equation =
          "tau_f += sum_i mu_i |tau|/N s_i/r_i, s_i' = w/N unless |s_i| = r_i, "
          "|tau| = sqrt(tau^2 + te^2) - te",
      .range = "any motion under up to rated torque; starts unloaded; short of |tau| by at most te",
      .not_modelled =
          "dependence of the yields on the load; difference between driving and "
          "back-driving",
      .source =
          "Hamon, Gautier, Garrec, IROS 2010 (load), with the memory of Maxwell slip (Iwan, 1966)",
      .parameters = {{"coefficient", "1", 0.0, 2.0, 0.06,
                      "BAM: 0.034 to 0.085 (eRob80:50), 0.15 (eRob80:100)"},
                     {"yield", "rad", 1e-7, 0.1, 5e-4,
                      "within the catalogue hysteresis of ratio 50, 2 arcmin"},
                     {"load_smoothing", "Nm", 1e-9, 1e3, 0.5,
                      "0.2 % of 226 Nm, the sensor's zero"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
      .repeats = true,
      .states = 1,
      .passive = false,
      .active_because =
          "elements that are wound at a small load give back more at a large one: at most "
          "mu r d|tau|/2N an element and change of load",
      .rate_independent = true};
  instantiate<PreslidingLoadFriction>(row);
  return row;
}

}  // namespace flexspline
