#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

constexpr std::size_t kGroup = 5;

// Parameters of an order: order, sine and cosine of the cogging, sine and cosine of the ripple.
struct TorqueRipple {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    using std::cos;
    using std::sin;
    S sum(0.0);
    for (std::size_t k = 0; k + kGroup <= p.size(); k += kGroup) {
      const S angle = p[k] * x.motor_angle;
      const S sine = p[k + 1] + p[k + 3] * x.motor_torque;
      const S cosine = p[k + 2] + p[k + 4] * x.motor_torque;
      sum += sine * sin(angle) + cosine * cos(angle);
    }
    return sum;
  }
};

}  // namespace

EffectRow describe_motor_torque_ripple() {
  EffectRow row{
      .id = "motor_torque_ripple",
      .coordinate = "motor_angle",
      .site = Site::motor,
      .equation =
          "tau_f += sum_k (c_k + r_k tau_m) sin n_k th1 + (d_k + q_k tau_m) cos n_k th1: "
          "recorded less true motor torque",
      .range = "the recorded motor torque is kt times a measured current; linear magnetics",
      .not_modelled = "growth of the orders with saturation; ripple of the current loop itself",
      .source = "Compliant Joint Toolbox (constant and torque-scaled ripple); Hanselman (2003)",
      .parameters = {{"order", "1", 0.01, 1000.0, 24.0,
                      "least common multiple of slots and poles, or 6 per pole pair: 12 to 84"},
                     {"cogging_sine", "Nm", -1e6, 1e6, 0.03, "0.5 to 3 % of the motor's 3.8 Nm"},
                     {"cogging_cosine", "Nm", -1e6, 1e6, 0.0, "phase, free"},
                     {"ripple_sine", "1", -1.0, 1.0, 0.02, "1 to 5 % of the torque"},
                     {"ripple_cosine", "1", -1.0, 1.0, 0.0, "phase, free"}},
      .rigs = {Rig::locked, Rig::free, Rig::servo},
      .repeats = true,
      .passive = false,
      .active_because = "part of the motor, which drives"};
  instantiate<TorqueRipple>(row);
  return row;
}

}  // namespace flexspline
