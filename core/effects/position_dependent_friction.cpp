#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

constexpr std::size_t kGroup = 4;

// Parameters of an order: order, amplitudes of sine and cosine, width of the sign.
struct PositionFriction {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    using std::cos;
    using std::sin;
    S sum(0.0);
    for (std::size_t k = 0; k + kGroup <= p.size(); k += kGroup) {
      const S angle = p[k] * x.motor_angle;
      const S wave = p[k + 1] * sin(angle) + p[k + 2] * cos(angle);
      sum += wave * smooth_sign(x.motor_speed, p[k + 3]);
    }
    return sum;
  }
};

}  // namespace

EffectRow describe_position_dependent_friction() {
  EffectRow row{
      .id = "position_dependent_friction",
      .coordinate = "motor_angle",
      .site = Site::motor,
      .equation = "tau_f += sum_k (a_k sin n_k th1 + b_k cos n_k th1) tanh(w/we)",
      .range =
          "beside a Coulomb friction tc >= the sum of the amplitudes, with which it is "
          "passive; turns of the motor, not fractions of one",
      .not_modelled = "growth of the amplitudes with load and speed",
      .source = "Tuttle (1992); Tuttle and Seering, IEEE T-RA 12(3), 1996",
      .parameters = {{"order", "1", 0.01, 1000.0, 2.0,
                      "1: assembly of the wave generator; 2: its two lobes"},
                     {"sine", "Nm", -1e6, 1e6, 6e-3, "2 to 20 % of tc = 0.06 Nm (judgement)"},
                     {"cosine", "Nm", -1e6, 1e6, 0.0, "phase, free"},
                     {"smoothing", "rad/s", 1e-9, 100.0, 0.5, "0.2 to 1 rad/s at the motor"}},
      .rigs = {Rig::locked, Rig::free, Rig::servo},
      .repeats = true,
      .passive = false,
      .active_because =
          "the changing part of a friction: passive beside a Coulomb friction of at least the sum "
          "of its amplitudes"};
  instantiate<PositionFriction>(row);
  return row;
}

}  // namespace flexspline
