#include <array>
#include <memory>

#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

/// Exact for a torsion that changes evenly within the step.
struct Branches {
  std::array<double, 3> stiffness{};
  std::array<double, 3> time{};
  std::array<double, 3> torque{};
  double torsion = 0.0;

  std::array<double, 3> after(const TorsionPoint& x) const {
    std::array<double, 3> next = torque;
    if (x.step <= 0.0) return next;
    const double rate = (x.torsion - torsion) / x.step;
    for (std::size_t i = 0; i < next.size(); ++i) {
      const double settled = stiffness[i] * time[i] * rate;
      next[i] = settled + (torque[i] - settled) * std::exp(-x.step / time[i]);
    }
    return next;
  }
};

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double stiffness = amount * scale.torque / scale.torsion;
  const double slow = scale.draw("viscoelastic_creep", 0, 1.0, 3.0) / scale.mean_rate;
  auto branches = std::make_shared<Branches>();
  branches->stiffness = {0.35 * stiffness, 0.4 * stiffness, 0.25 * stiffness};
  branches->time = {slow / 5.0, slow, slow * 5.0};
  HiddenLaw law;
  law.parameters = {{"sum_of_stiffnesses", stiffness, "Nm/rad"}, {"middle_time", slow, "s"}};
  law.transmission = [branches](const TorsionPoint& x) {
    double sum = 0.0;
    for (const double q : branches->after(x)) sum += q;
    return sum;
  };
  law.remember = [branches](const TorsionPoint& x) {
    branches->torque = branches->after(x);
    branches->torsion = x.torsion;
  };
  return law;
}

}  // namespace

HiddenRow describe_viscoelastic_creep() {
  return {.id = "viscoelastic_creep",
          .coordinate = "lag",
          .equation =
              "tau += sum q_i, q_i' = k_i phi' - q_i/T_i, three branches, T in ratio 1 : 5 : 25",
          .site = HiddenSite::transmission,
          .rigs = {Rig::locked, Rig::free, Rig::specimen},
          .dissipates = true,
          .make = make};
}

}  // namespace flexspline::data
