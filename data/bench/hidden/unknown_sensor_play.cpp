#include <algorithm>
#include <array>

#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

constexpr std::array<double, 3> kReach = {0.05, 0.15, 0.4};  // of the peak torque
constexpr std::array<double, 3> kShare = {0.5, 0.3, 0.2};

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double height = amount * scale.torque;
  const double peak = scale.torque;
  HiddenLaw law;
  law.parameters = {{"height", height, "Nm"}, {"smallest_reach", kReach[0] * peak, "Nm"}};
  law.sensing = [=](HiddenSignals& s) {
    std::array<double, 3> stop = {};
    double last = 0.0;
    for (double& torque : s.torque) {
      const double step = (torque - last) / peak;
      last = torque;
      for (std::size_t k = 0; k < stop.size(); ++k) {
        stop[k] = std::clamp(stop[k] + step, -kReach[k], kReach[k]);
        torque += height * kShare[k] * stop[k] / kReach[k];
      }
    }
  };
  return law;
}

}  // namespace

HiddenRow describe_unknown_sensor_play() {
  return {.id = "unknown:sensor_play",
          .coordinate = "",
          .equation =
              "y_tau = tau + a sum_k c_k s_k/r_k, s_k the stop operator of tau with reach r_k: "
              "Prandtl-Ishlinskii hysteresis of the torque sensor",
          .site = HiddenSite::torque_sensor,
          .rigs = {Rig::free},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
