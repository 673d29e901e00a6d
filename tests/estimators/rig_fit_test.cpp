// The constants of a rig beside its torsion law, against shafts whose equations are made by hand,
// and against a bench that shares no code with the fit.
#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/core/rig_residuals.hpp"
#include "flexspline/core/torsion_record.hpp"
#include "flexspline/data/hidden_bench.hpp"
#include "flexspline/estimators/method.hpp"
#include "flexspline/estimators/rig_fit.hpp"
#include "rig/shaft_equation.hpp"

namespace flexspline::estimators {
namespace {

using testing::HasSubstr;

ShaftEquation shaft(double noise, bool waves) {
  ShaftEquation equation{.dry = true, .names = {"J", "B", "c", "w"}};
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0.0, noise);
  for (int i = 0; i < 4000; ++i) {
    const double t = 1e-3 * i;
    const double speed = waves ? 20.0 * std::sin(9.0 * t) + 8.0 * std::sin(2.0 * t) + 1.0
                               : (i < 2000 ? 20.0 : -20.0);
    const double acceleration = waves ? 180.0 * std::cos(9.0 * t) + 16.0 * std::cos(2.0 * t) : 0.0;
    equation.speed.push_back(speed);
    equation.acceleration.push_back(acceleration);
    equation.torque.push_back(7e-4 * acceleration + 6e-4 * speed + 0.03 * std::tanh(speed / 1.3) +
                              normal(random));
  }
  return equation;
}

TEST(ShaftEquation, IsRecoveredWithinItsIntervals) {
  const auto constants = fitted(shaft(2e-3, true), false);
  ASSERT_EQ(constants.size(), 4u);
  const double truth[] = {7e-4, 6e-4, 0.03};
  for (std::size_t k = 0; k < 3; ++k) {
    const ParameterEstimate& one = constants[k].estimate;
    EXPECT_TRUE(constants[k].identifiable) << one.name;
    EXPECT_NEAR(one.value, truth[k], 3.0 * one.std) << one.name;
    EXPECT_LT(one.std, 0.05 * truth[k]) << one.name;
  }
  EXPECT_TRUE(constants[3].identifiable);
  EXPECT_NEAR(constants[3].estimate.value, 1.3, 0.15);
}

// tanh(v/w) and v are one column there: only the sum of viscous and dry friction shows.
TEST(ShaftEquation, OneSpeedDoesNotTellViscousFromDry) {
  const auto constants = fitted(shaft(2e-3, false), true);
  ASSERT_EQ(constants.size(), 3u);
  EXPECT_FALSE(constants[2].identifiable) << "the width";
  EXPECT_FALSE(constants[0].identifiable && constants[1].identifiable);
}

struct Bench {
  data::HiddenGear gear;
  RecordingSet set;
};

Bench bench(Rig rig) {
  const data::HiddenBench drawn = data::draw_hidden_bench(rig, 5);
  auto made = data::run_hidden_bench(drawn, {});
  EXPECT_TRUE(made) << (made ? "" : made.error().message());
  Bench bench{drawn.gear, made ? std::move(made->measured) : RecordingSet{}};
  for (Recording& one : bench.set.recordings) one.split = Split::train;
  return bench;
}

Estimate torsion_of(const RecordingSet& set) {
  FitProblem problem;
  problem.records = *torsion_records(set);
  auto estimate = (*find_method("static_regression"))->fit(problem);
  EXPECT_TRUE(estimate) << (estimate ? "" : estimate.error().message());
  return estimate ? *estimate : Estimate{};
}

double fastest(const RecordingSet& set) {
  double speed = 0.0;
  for (const Recording& one : set.recordings) {
    const auto channels = drive_channels(set.rig, {}, one);
    for (double v : channels->motor_speed) speed = std::max(speed, std::abs(v));
  }
  return speed;
}

class WholeRig : public testing::TestWithParam<Rig> {};

// The bench's friction is another function: c v/sqrt(v^2 + s^2).
TEST_P(WholeRig, HasTheFrictionOfTheBench) {
  const Bench b = bench(GetParam());
  const auto fit = complete_rig(b.set, torsion_of(b.set).model);
  ASSERT_TRUE(fit) << fit.error().message();
  EXPECT_EQ(fit->model.rig, GetParam());
  EXPECT_EQ(fit->model.origin.at("gear_ratio"), Origin::given);
  EXPECT_EQ(fit->model.origin.at("motor_inertia"), Origin::given);
  EXPECT_EQ(fit->model.origin.at("motor_coulomb"), Origin::fitted);
  const DriveSpec& d = fit->model.drive;
  const double top = fastest(b.set);
  for (const double share : {0.3, 0.5, 0.7, 0.9}) {
    const double v = share * top;
    const double truth = b.gear.motor_drag * v +
                         b.gear.motor_coulomb * v / std::hypot(v, b.gear.motor_coulomb_speed);
    const double found = d.motor_viscous * v + d.motor_coulomb * std::tanh(v / d.coulomb_width);
    EXPECT_NEAR(found, truth, 0.12 * truth) << "at " << share << " of the largest speed";
  }
  if (GetParam() == Rig::free) {
    EXPECT_NEAR(d.load_viscous, b.gear.load_drag, 0.1 * b.gear.load_drag);
  }
}

TEST_P(WholeRig, FitsAnInertiaThatIsNotStated) {
  RecordingSet set = bench(GetParam()).set;
  const Estimate torsion = torsion_of(set);
  const double stated = set.constants.at("motor_inertia_kgm2");
  set.constants.erase("motor_inertia_kgm2");
  const auto fit = complete_rig(set, torsion.model);
  ASSERT_TRUE(fit) << fit.error().message();
  const auto found = std::ranges::find(fit->parameters, "motor_inertia", &ParameterEstimate::name);
  ASSERT_NE(found, fit->parameters.end());
  EXPECT_NEAR(found->value, stated, std::max(4.0 * found->std, 0.05 * stated));
  const bool told = found->value > 1.96 * found->std;
  EXPECT_EQ(fit->model.origin.at("motor_inertia"),
            told ? Origin::fitted : Origin::not_identifiable);
}

INSTANTIATE_TEST_SUITE_P(Rigs, WholeRig, testing::Values(Rig::locked, Rig::free),
                         [](const auto& param) { return std::string(name_of(param.param)); });

TEST(WholeRig, SaysWhatNoChannelTells) {
  RecordingSet set = bench(Rig::locked).set;
  for (Recording& one : set.recordings) one.channels.erase(Quantity::motor_torque);
  const auto fit = complete_rig(set, torsion_of(set).model);
  ASSERT_TRUE(fit) << fit.error().message();
  EXPECT_EQ(fit->model.origin.at("motor_coulomb"), Origin::not_identifiable);
  ASSERT_FALSE(fit->notes.empty());
  EXPECT_THAT(fit->notes.front(), HasSubstr("motor_torque is not measured"));
}

TEST(CorrectionsOfARig, ThatNearlyCancelAreLeftOutAndTriflesAreNoted) {
  const RecordingSet set = bench(Rig::locked).set;
  auto fit = complete_rig(set, torsion_of(set).model);
  ASSERT_TRUE(fit);
  fit->model.drive.torsion.effects = {
      {"coulomb_viscous_friction", {{"coulomb", 0.02}, {"viscous", 0.0}, {"smoothing", 0.02}}},
      {"motor_torque_offset", {{"offset", 1e-6}}},
      {"torque_sensor_gain", {{"error", 0.10}}},
      {"torque_sensor_gain", {{"error", -0.095}}}};
  const auto judged = judge_corrections(set, fit->model);
  ASSERT_TRUE(judged) << judged.error().message();
  const auto& left = judged->model.drive.torsion.effects;
  ASSERT_EQ(left.size(), 2u);
  EXPECT_EQ(left[0].effect, "coulomb_viscous_friction");
  EXPECT_EQ(left[0].note, "");
  EXPECT_THAT(left[1].note, HasSubstr("too small to be named"));
  EXPECT_THAT(judged->notes, testing::Contains(HasSubstr("nearly cancel")));
}

}  // namespace
}  // namespace flexspline::estimators
