// The joint that is written, simulated by MuJoCo itself under node, against our own simulation.
#include <nlohmann/json.hpp>

#include "claims/claims.hpp"
#include "export_fixture.hpp"
#include "flexspline/core/simulate_rig.hpp"
#include "mujoco_dir.hpp"
#include "source_dir.hpp"

namespace flexspline::data {
namespace {

const std::filesystem::path kSource = FLEXSPLINE_SOURCE_DIR;

/// Where the npm package @mujoco/mujoco lies.
std::filesystem::path engine() {
  return std::filesystem::path(FLEXSPLINE_MUJOCO_DIR) / "node_modules/@mujoco/mujoco";
}

constexpr double kInterval = 2e-3;

Recording excitation(double amplitude, double seconds) {
  Recording recording;
  recording.id = "excitation";
  for (int k = 0; k * kInterval <= seconds + 1e-9; ++k) {
    const double t = k * kInterval;
    const double w = 2.0 * std::numbers::pi * t;
    recording.time.push_back(t);
    recording.channels[Quantity::motor_torque].push_back(
        amplitude * (0.5 * std::sin(0.3 * w) + 0.3 * std::sin(0.71 * w) + 0.2 * std::sin(1.3 * w)));
  }
  return recording;
}

nlohmann::json played(const RigModel& model, const Recording& input) {
  const ExportFolder folder;
  write_export("mjcf", carried("mjcf", model).model, folder);
  folder.write({{"input.json", nlohmann::json{{"interval", kInterval},
                                              {"torque", input.channels.at(Quantity::motor_torque)}}
                                   .dump()}});
  const int code =
      folder.run(fmt::format("node {} {} drive.xml input.json > output.json",
                             (kSource / "tests/data/mujoco/play.mjs").string(), engine().string()));
  EXPECT_EQ(code, 0) << "MuJoCo refuses the model";
  return code == 0
             ? nlohmann::json::parse(read_file(folder.path() / "output.json").value_or("null"))
             : nlohmann::json();
}

/// Largest distance between both over the range of ours.
double distance(const std::vector<double>& ours, const std::vector<double>& theirs) {
  const auto [low, high] = std::ranges::minmax(ours);
  double most = 0.0;
  for (std::size_t k = 0; k < ours.size(); ++k)
    most = std::max(most, std::abs(ours[k] - theirs[k]));
  return most / (high - low);
}

class InMuJoCo : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(exists(engine() / "mujoco.js")) << "the build installs it"; }
  // Runs both and compares the load's angle, where it is named as the page has it too; the motor's
  // with it where it turns on its own.
  void expect_within(const RigModel& model, double amplitude, double share,
                     const std::string& claim = {}) {
    const Recording input = excitation(amplitude, 10.0);
    const auto ours = motions_under(model, input);
    ASSERT_TRUE(ours) << ours.error().message();
    const auto theirs = played(model, input);
    ASSERT_TRUE(theirs.is_object());
    const double load = distance(*ours->find(Quantity::load_angle), theirs.at("load"));
    EXPECT_LT(load, share);
    if (!claim.empty()) claims::expect("docs/export.md", claim, {{"load", load}});
    if (model.rig != Rig::free) return;
    EXPECT_LT(distance(*ours->find(Quantity::motor_angle), theirs.at("motor")), share);
  }
};

RigModel baseline(Rig rig) {
  RigModel model = example_model(rig);
  model.drive.torsion.h.coefficients.clear();
  model.drive.coulomb_width = 0.02;
  return model;
}

TEST_F(InMuJoCo, TheFreeRigMovesAsOurs) {
  expect_within(baseline(Rig::free), 1.5, 1e-3, "mujoco-free");
}

TEST_F(InMuJoCo, TheServoMovesAsOurs) {
  RigModel model = baseline(Rig::servo);
  model.drive.load_inertia = 0.6;
  expect_within(model, 0.8, 1e-3, "mujoco-servo");
}

TEST_F(InMuJoCo, WeightOffsetAndGainOfTheMotorAreHeld) {
  RigModel model = baseline(Rig::free);
  model.drive.torsion.effects = {{"gravity_load", {{"moment", 6.0}, {"phase", 0.4}}},
                                 {"motor_torque_offset", {{"offset", 0.05}}},
                                 {"torque_constant_error", {{"error", -0.1}}}};
  expect_within(model, 1.5, 1e-3);
}

// Friction with memory against our own simulation of the same model, in the engine.
struct Friction {
  std::string name;
  Rig rig = Rig::free;
  EffectSpec effect;
  std::string claim;
  double share = 1e-3;
};

std::ostream& operator<<(std::ostream& out, const Friction& one) { return out << one.name; }

class FrictionInMuJoCo : public InMuJoCo, public testing::WithParamInterface<Friction> {};

TEST_P(FrictionInMuJoCo, MovesAsOurs) {
  RigModel model = baseline(GetParam().rig);
  if (GetParam().rig == Rig::servo) model.drive.load_inertia = 0.6;
  if (GetParam().effect.effect == "lugre_friction") model.drive.motor_coulomb = 0.0;
  model.drive.torsion.effects = {GetParam().effect};
  EXPECT_EQ(carried("mjcf", model).model.drive.torsion.effects.size(), 1u);
  expect_within(model, GetParam().rig == Rig::servo ? 0.8 : 1.5, GetParam().share,
                GetParam().claim);
}

const EffectSpec kLuGre = {"lugre_friction",
                           {{"coulomb", 0.03},
                            {"excess", 0.015},
                            {"stribeck_speed", 5.0},
                            {"slip_length", 0.02},
                            {"damping", 0.02}}};
const EffectSpec kStribeck = {
    "stribeck_friction",
    {{"excess", 0.015}, {"stribeck_speed", 5.0}, {"exponent", 2.0}, {"smoothing", 0.02}}};
const EffectSpec kDahl = {"dahl_hysteresis", {{"height", 4.5}, {"slip_length", 3e-4}}};
const EffectSpec kSlips = {
    "presliding_hysteresis",
    {{"stiffness", 4000.0}, {"yield", 2e-4}, {"stiffness", 3000.0}, {"yield", 6e-4}}};

INSTANTIATE_TEST_SUITE_P(
    Effects, FrictionInMuJoCo,
    testing::Values(Friction{"lugre_free", Rig::free, kLuGre, "mujoco-lugre-free"},
                    // A pendulum that lets go a step late swings on late.
                    Friction{"lugre_servo", Rig::servo, kLuGre, "mujoco-lugre-servo", 1e-2},
                    Friction{"stribeck_free", Rig::free, kStribeck, "mujoco-stribeck-free"},
                    Friction{"dahl_free", Rig::free, kDahl, "mujoco-dahl-free"},
                    Friction{"slips_free", Rig::free, kSlips, "mujoco-slips-free"}),
    [](const auto& one) { return one.param.name; });

TEST_F(InMuJoCo, AStribeckCurveOfAnotherExponentIsRefused) {
  RigModel model = baseline(Rig::free);
  EffectSpec other = kStribeck;
  other.parameters[2].second = 1.0;
  model.drive.torsion.effects = {other};
  const Carried c = carried("mjcf", model);
  EXPECT_TRUE(c.model.drive.torsion.effects.empty());
  EXPECT_THAT(c.lost.front().why, testing::HasSubstr("exponent 2"));
}

// What the form cannot hold is measured by us as the engine has it: the carried model is what is
// compared.
TEST_F(InMuJoCo, WhatIsLostIsWhatTheEngineLacks) {
  RigModel model = example_model(Rig::free);
  model.drive.torsion.g_inverse = law_spec("power_law", 0.05, {4.0, 0.5});
  const Carried c = carried("mjcf", model);
  EXPECT_EQ(c.lost.size(), 3u) << "g^-1, h, the width of dry friction";
  const Recording input = excitation(1.5, 10.0);
  const auto whole = motions_under(model, input);
  const auto form = motions_under(c.model, input);
  ASSERT_TRUE(whole && form);
  const auto theirs = played(model, input);
  ASSERT_TRUE(theirs.is_object());
  const auto& angle = *form->find(Quantity::load_angle);
  EXPECT_LT(distance(angle, theirs.at("load")), 1e-3);
}

}  // namespace
}  // namespace flexspline::data
