// Derivatives of every rig: forward, adjoint and by differences agree to six digits.
#include <algorithm>

#include "claims/claims.hpp"
#include "rig_examples.hpp"

namespace flexspline {
namespace {

/// Largest difference, of the largest derivative.
constexpr double kDifference = 1e-6;

struct Case {
  std::string name;
  Rig rig;
  std::string form;
  std::vector<EffectSpec> effects;
  RigInputs inputs;
};

std::vector<Case> cases() {
  const EffectSpec creep{"viscoelastic_creep", {{"stiffness", 4500.0}, {"time_constant", 0.05}}};
  const RigInputs torque{{{Quantity::motor_torque, sine(0.4, 2.0)}}, {}};
  const RigInputs angle{{{Quantity::commanded_angle, sine(0.1, 2.0)}}, {}};
  const RigInputs bridge{
      {{Quantity::duty_cycle, sine(0.5, 2.0)}, {Quantity::supply_voltage, constant(12.0)}}, {}};
  const RigInputs loop{
      {{Quantity::commanded_angle, sine(0.5, 2.0)}, {Quantity::supply_voltage, constant(12.0)}},
      {},
      constant(1.5)};
  const EffectSpec series{"series_compliance", {{"compliance", 4.8e-5}}};
  const EffectSpec wave{"load_dependent_kinematic_error",
                        {{"compliance", 1e-5}, {"order", 2.0}, {"phase", 0.3}}};
  const EffectSpec error{"kinematic_error",
                         {{"amplitude", 1.5e-4}, {"order", 2.0}, {"phase", 0.3}}};
  return {{"locked", Rig::locked, "inertial", {}, torque},
          {"locked_yielding", Rig::locked, "inertial", {series, wave}, torque},
          {"reduced_yielding", Rig::locked, "reduced", {series}, torque},
          {"free_yielding", Rig::free, "motor_driven", {series, error}, torque},
          {"free_held_yielding", Rig::free, "position_loop", {series}, angle},
          {"locked_playing",
           Rig::locked,
           "inertial",
           {{"play_backlash", {{"half_gap", 1e-4}, {"friction", 4.5}}}},
           torque},
          {"free_lagging",
           Rig::free,
           "position_loop",
           {{"current_lag", {{"time_constant", 1e-3}}}},
           angle},
          {"specimen_yielding",
           Rig::specimen,
           "force_driven",
           {series, creep},
           {{{Quantity::transmitted_torque, sine(20.0, 2.0)}}, {}}},
          {"reduced", Rig::locked, "reduced", {creep}, torque},
          {"held", Rig::locked, "position_loop", {}, angle},
          {"free", Rig::free, "motor_driven", {creep}, torque},
          {"free_held", Rig::free, "position_loop", {}, angle},
          {"specimen",
           Rig::specimen,
           "force_driven",
           {creep},
           {{{Quantity::transmitted_torque, sine(20.0, 2.0)}}, {}}},
          {"specimen_moved",
           Rig::specimen,
           "displacement_driven",
           {creep},
           {{{Quantity::torsion, sine(2e-3, 2.0)}}, {}}},
          {"specimen_moved_yielding",
           Rig::specimen,
           "displacement_driven",
           {series, creep},
           {{{Quantity::torsion, sine(2e-3, 2.0)}}, {}}},
          {"servo", Rig::servo, "torque_driven", {}, torque},
          {"servo_current",
           Rig::servo,
           "current_driven",
           {},
           {{{Quantity::current, sine(4.0, 2.0)}}, {}}},
          {"servo_voltage", Rig::servo, "voltage_driven", {}, bridge},
          {"servo_winding", Rig::servo, "winding", {}, bridge},
          {"servo_held", Rig::servo, "position_loop", {}, loop},
          {"servo_compliant", Rig::servo, "compliant", {series, error}, torque},
          {"servo_compliant_current",
           Rig::servo,
           "compliant_current",
           {error},
           {{{Quantity::current, sine(4.0, 2.0)}}, {}}},
          {"servo_compliant_voltage", Rig::servo, "compliant_voltage", {series}, bridge}};
}

class EveryRig : public testing::TestWithParam<Case> {};

SystemSettings tight(std::size_t states) {
  SystemSettings settings;
  settings.relative_tolerance = 1e-11;
  settings.absolute_tolerance.assign(states, 1e-13);
  settings.max_steps = 5000000;
  return settings;
}

TEST_P(EveryRig, HasTheDerivativesOfItsTrajectory) {
  const Case& one = GetParam();
  DriveSpec drive = example_drive();
  drive.torsion.effects = one.effects;
  if (one.rig == Rig::specimen) drive.gear_ratio = 1.0;
  const auto rig = made_rig(one.rig, drive, one.inputs, one.form);
  const std::size_t n = rig->states();
  const auto p = rig->parameter_vector();
  const auto times = instants(0.3, 3);
  std::vector<double> start(n, 0.0);
  // Away from zero motion, where powers of zero have no difference to show.
  const bool imposed = one.form == "displacement_driven";
  start[0] = imposed ? 0.0 : one.rig == Rig::specimen ? 5e-4 : one.rig == Rig::servo ? 0.3 : 0.03;
  const auto settings = tight(n);
  const auto forward = integrate_with_sensitivities(*rig, p, times, start, {}, settings);
  ASSERT_TRUE(forward) << forward.error().message();
  std::vector<double> weight(times.size() * n, 0.0);
  weight[times.size() * n - n] = 1.0;
  const auto adjoint = adjoint_gradient(*rig, p, times, start, {}, weight, settings);
  ASSERT_TRUE(adjoint) << adjoint.error().message();
  const std::size_t last = (times.size() - 1) * n * p.size();
  double worst_adjoint = 0.0;
  double worst_difference = 0.0;
  double size = 0.0;
  const auto scale = [&](std::size_t k) { return std::max(std::abs(p[k]), 1e-9); };
  for (std::size_t k = 0; k < p.size(); ++k) {
    size = std::max(size, std::abs(forward->sensitivity[last + k]) * scale(k));
  }
  ASSERT_GT(size, 0.0);
  for (std::size_t k = 0; k < p.size(); ++k) {
    const double exact = forward->sensitivity[last + k];
    worst_adjoint = std::max(worst_adjoint, std::abs(exact - (*adjoint)[k]) * scale(k) / size);
    double ends[4];
    const double steps[] = {1.0, -1.0, 2.0, -2.0};
    const double step = 6e-3 * scale(k);
    for (std::size_t s = 0; s < 4; ++s) {
      auto moved = p;
      moved[k] += steps[s] * step;
      const auto run = integrate_system(*rig, moved, times, start, settings);
      ASSERT_TRUE(run) << run.error().message();
      ends[s] = run->state[(times.size() - 1) * n];
    }
    const double difference = (8.0 * (ends[0] - ends[1]) - (ends[2] - ends[3])) / (12.0 * step);
    worst_difference = std::max(worst_difference, std::abs(exact - difference) * scale(k) / size);
  }
  std::printf("%s: %zu states, %zu parameters, forward-adjoint %.1e, forward-difference %.1e\n",
              one.name.c_str(), n, p.size(), worst_adjoint, worst_difference);
  EXPECT_LT(worst_adjoint, kDifference);
  EXPECT_LT(worst_difference, kDifference);
}

TEST(EveryRigOfThePage, HasItsDerivatives) {
  claims::expect("docs/simulation.md", "rig-derivatives",
                 {{"rigs", static_cast<double>(cases().size())}, {"difference", kDifference}});
}

INSTANTIATE_TEST_SUITE_P(Rigs, EveryRig, testing::ValuesIn(cases()),
                         [](const auto& param) { return param.param.name; });

}  // namespace
}  // namespace flexspline
