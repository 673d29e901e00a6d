#include "bench/hidden_differences.hpp"
#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double delay = amount * scale.torsion / scale.speed;
  HiddenLaw law;
  law.parameters = {{"delay", delay, "s"}};
  law.sensing = [=](HiddenSignals& s) { s.load_angle = delayed(s.load_angle, delay / s.step); };
  return law;
}

}  // namespace

HiddenRow describe_encoder_skew() {
  return {.id = "encoder_skew",
          .coordinate = "lag",
          .equation = "y_2(t) = th2(t - d)",
          .site = HiddenSite::encoder,
          .rigs = {Rig::free},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
