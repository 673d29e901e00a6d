// The motions under a torque, and the torques along those motions, are each other's inverse.
#include "flexspline/core/simulate_rig.hpp"
#include "rig_examples.hpp"

namespace flexspline {
namespace {

class ThereAndBack : public testing::TestWithParam<Rig> {};

Recording under_a_torque() {
  Recording recording;
  recording.id = "there";
  for (int k = 0; k <= 4000; ++k) {
    const double t = 1e-3 * k;
    recording.time.push_back(t);
    recording.channels[Quantity::motor_torque].push_back(0.6 * std::sin(5.0 * t) +
                                                         0.3 * std::sin(11.0 * t));
  }
  return recording;
}

TEST_P(ThereAndBack, MotorTorqueComesBack) {
  RigModel model{GetParam(), example_drive()};
  model.drive.coulomb_width = 5.0;
  if (model.rig == Rig::free) {
    model.drive.torsion.effects = {
        {"stribeck_friction",
         {{"excess", 2.0}, {"stribeck_speed", 0.1}, {"exponent", 2.0}, {"smoothing", 0.05}},
         "",
         true}};
  }
  const Recording input = under_a_torque();
  const auto there = motions_under(model, input);
  ASSERT_TRUE(there) << there.error().message();
  const auto back = torques_along(model, *there);
  ASSERT_TRUE(back) << back.error().message();
  const auto& given = input.channels.at(Quantity::motor_torque);
  const auto& found = *back->find(Quantity::motor_torque);
  double squares = 0.0;
  for (std::size_t k = 100; k + 100 < given.size(); ++k)
    squares += std::pow(found[k] - given[k], 2);
  EXPECT_LT(std::sqrt(squares / 3800.0), 5e-3 * 0.9) << "derivatives of a smoothed angle";
}

INSTANTIATE_TEST_SUITE_P(Rigs, ThereAndBack, testing::Values(Rig::free, Rig::servo, Rig::locked));

}  // namespace
}  // namespace flexspline
