#include <algorithm>

#include "bench/hidden_differences.hpp"
#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

/// q'' + 2 z w q' + w^2 q = -u, exact for u that is constant within a step.
class Oscillator {
 public:
  Oscillator(double rate, double damping, double step)
      : decay_(std::exp(-damping * rate * step)),
        cosine_(std::cos(turn(rate, damping) * step)),
        sine_(std::sin(turn(rate, damping) * step)),
        damped_(turn(rate, damping)),
        loss_(damping * rate),
        square_(rate * rate) {}

  double next(double u) {
    const double rest = -u / square_;
    const double x = place_ - rest;
    const double v = (speed_ + loss_ * x) / damped_;
    place_ = rest + decay_ * (x * cosine_ + v * sine_);
    speed_ = decay_ * ((v * damped_ - loss_ * x) * cosine_ - (x * damped_ + v * loss_) * sine_);
    return place_;
  }

 private:
  static double turn(double rate, double damping) {
    return rate * std::sqrt(1.0 - damping * damping);
  }

  double decay_, cosine_, sine_, damped_, loss_, square_;
  double place_ = 0.0;
  double speed_ = 0.0;
};

HiddenLaw make(const HiddenScale& scale, double amount) {
  // Above the fastest motion, so that it rings rather than follows.
  const double fastest = std::max(scale.torque_rate / scale.torque, 5.0 * scale.mean_rate);
  const double rate = scale.draw("unknown:fixture_resonance", 0, 1.2, 3.0) * fastest;
  const double damping = scale.draw("unknown:fixture_resonance", 1, 0.02, 0.08);
  HiddenLaw law;
  law.parameters = {
      {"participation", amount, ""}, {"rate", rate, "rad/s"}, {"damping", damping, ""}};
  law.sensing = [=](HiddenSignals& s) {
    const std::vector<double> bend = bends(s.torque, s.step);
    Oscillator mode(rate, damping, s.step);
    for (std::size_t k = 0; k < s.size(); ++k) s.torque[k] += amount * mode.next(bend[k]);
  };
  return law;
}

}  // namespace

HiddenRow describe_unknown_fixture_resonance() {
  return {.id = "unknown:fixture_resonance",
          .coordinate = "lag",
          .equation =
              "y_tau = tau + a q, q'' + 2 z w q' + w^2 q = -tau'': a mode of what holds the sensor",
          .site = HiddenSite::torque_sensor,
          .rigs = {Rig::locked, Rig::free, Rig::specimen},
          .dissipates = false,
          .make = make,
          .joint = true};
}

}  // namespace flexspline::data
