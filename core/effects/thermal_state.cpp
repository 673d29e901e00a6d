#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

enum : std::size_t {
  kCoulomb,
  kViscous,
  kCoulombSlope,
  kViscousSlope,
  kCapacity,
  kConductance,
  kCopper,
  kWidth
};

// One state: the temperature above the surroundings.
struct ThermalState {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S> z) {
    using std::exp;
    const S coulomb = p[kCoulomb] * exp(-p[kCoulombSlope] * z[0]);
    const S viscous = p[kViscous] * exp(-p[kViscousSlope] * z[0]);
    return coulomb * smooth_sign(x.motor_speed, p[kWidth]) + viscous * x.motor_speed;
  }

  template <class S>
  static S loss(const Instant<S>& x, std::span<const S> p, std::span<const S> z) {
    const S friction = term(x, p, z) * x.motor_speed;
    return friction + p[kCopper] * x.motor_torque * x.motor_torque;
  }

  // Exact for a loss that is constant over the step: the mean of its ends.
  template <class S>
  static void advance(const Instant<S>& from, const Instant<S>& to, std::span<const S> p,
                      std::span<S> z) {
    const std::span<const S> state(z);
    const S power = 0.5 * (loss(from, p, state) + loss(to, p, state));
    const S gained = power - p[kConductance] * z[0];
    const S step = (to.time - from.time) / p[kCapacity];
    z[0] += gained * step * mean_left(p[kConductance] * step);
  }

  template <class S>
  static void rate(const Instant<S>& x, std::span<const S> p, std::span<const S> z,
                   std::span<S> dz) {
    dz[0] = (loss(x, p, z) - p[kConductance] * z[0]) / p[kCapacity];
  }
};

}  // namespace

EffectRow describe_thermal_state() {
  EffectRow row{
      .id = "thermal_state",
      .coordinate = "temperature",
      .site = Site::motor,
      .equation =
          "tau_f += F = tc exp(-bc T) tanh(w/we) + B exp(-bv T) w; C T' = F w + q tau_m^2 - "
          "G T",
      .range =
          "T within 40 K of the surroundings, where Arrhenius' law is exponential; steps well "
          "below C/G; starts at T = 0",
      .not_modelled =
          "gradients within the unit; surroundings that warm up; heat of other effects; "
          "stiffness and torque constant over temperature",
      .source = "Simoni, Beschi, Legnani, Visioli, Robotica 2017; Wolf and Iskandar, ICRA 2018",
      .parameters = {{"coulomb", "Nm", 0.0, 1e6, 0.06, "starting torque, 1 to 2 % of rated / N"},
                     {"viscous", "Nm s/rad", 0.0, 1e6, 1e-3, "cold: 4e-4 to 1e-3"},
                     {"coulomb_slope", "1/K", -0.1, 0.2, 0.01,
                      "weaker than viscosity's (judgement)"},
                     {"viscous_slope", "1/K", -0.1, 0.2, 0.035,
                      "grease: 0.02 to 0.05; halves in 20 K"},
                     {"heat_capacity", "J/K", 0.01, 1e7, 2000.0, "4 kg of steel at 480 J/(kg K)"},
                     {"conductance", "W/K", 1e-5, 1e4, 1.1, "C/G = 600 to 3000 s"},
                     {"copper_loss", "W/Nm2", 0.0, 1e5, 2.0,
                      "share of a 1.6 kW motor's winding loss that warms the gear (judgement)"},
                     {"smoothing", "rad/s", 1e-9, 100.0, 0.5, "0.2 to 1 rad/s at the motor"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
      .states = 1};
  instantiate<ThermalState>(row);
  return row;
}

}  // namespace flexspline
