#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// Parameters: drag at 1 rad/s, exponent, speed below which it is linear.
struct PowerLaw {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    const S& w = x.motor_speed;
    const S square = w * w + p[2] * p[2];
    const S half = 0.5 * (p[1] - 1.0);
    return p[0] * w * positive_power(square, half);
  }
};

}  // namespace

EffectRow describe_nonlinear_viscous_friction() {
  EffectRow row{
      .id = "nonlinear_viscous_friction",
      .coordinate = "velocity",
      .site = Site::motor,
      .equation = "tau_f += c w (w^2 + we^2)^((n-1)/2), speeds in rad/s: c |w|^n sgn w beyond we",
      .range =
          "any speed of one lubrication regime; within |n-1|/2 (we/w)^2 of the power law, "
          "linear below we",
      .not_modelled =
          "temperature of the lubricant; at n = 1 it is the baseline's viscous friction",
      .source = "Palmgren: churning torque ~ (nu n)^(2/3); Wolf and Iskandar, ICRA 2018",
      .parameters = {{"drag", "Nm", 0.0, 1e9, 3.6e-3,
                      "at 1 rad/s; 0.13 Nm at 2000 rpm, where B w with B = 6e-4 is as large"},
                     {"exponent", "1", 0.1, 4.0, 2.0 / 3.0,
                      "Palmgren 2/3; 0.5 to 0.8 seen; fluid dampers 0.3 to 2"},
                     {"smoothing", "rad/s", 1e-9, 100.0, 0.5, "0.2 to 1 rad/s at the motor"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo}};
  instantiate<PowerLaw>(row);
  return row;
}

}  // namespace flexspline
