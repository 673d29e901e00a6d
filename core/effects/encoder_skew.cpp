#include "delayed.hpp"
#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// To first order, for derivatives at an instant; signals are mapped exactly.
struct EncoderSkew {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    return -p[0] * x.load_speed;
  }
};

void map(std::span<const double> time, std::span<double> signal,
         std::span<const double> parameters) {
  delay_signal(time, signal, parameters[0]);
}

}  // namespace

EffectRow describe_encoder_skew() {
  EffectRow row{.id = "encoder_skew",
                .coordinate = "lag",
                .site = Site::load_angle_signal,
                .equation = "theta_l,measured(t) = theta_l(t - d)",
                .range = "load angle late against motor angle; |d| well below a period",
                .not_modelled = "jitter; clocks that run at different rates",
                .source = "encoders read one after another on a bus: 10 us to 1 ms",
                .parameters = {{"delay", "s", -10.0, 10.0, 1e-4, "a tenth of a bus cycle of 1 ms"}},
                .rigs = {Rig::free},
                .passive = false,
                .active_because = "an instrument: it shows what is not there, and does no work"};
  instantiate<EncoderSkew>(row);
  row.map = map;
  return row;
}

}  // namespace flexspline
