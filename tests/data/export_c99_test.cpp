// The C that is written, compiled by the compilers at hand, against our own equations.
#include "claims/claims.hpp"
#include "export/c_effects.hpp"
#include "export_fixture.hpp"
#include "flexspline/core/effect_path.hpp"
#include "flexspline/core/law.hpp"

namespace flexspline::data {
namespace {

/// Of a rate or a state, or absolute where it is small.
constexpr double kDifference = 1e-9;

constexpr const char* kFlags = "-std=c99 -Wall -Wextra -pedantic -Werror -O1 -fPIC -shared";

struct Input {
  double motor_torque;
  double load_torque;
};

struct Output {
  double motor_angle, motor_speed, load_angle, load_speed, torsion, transmitted_torque;
};

/// The exported model, compiled and loaded.
class CDrive {
 public:
  explicit CDrive(const RigModel& model, const std::string& compiler = "gcc") {
    write_export("c99", model, folder_);
    const int code =
        folder_.run(fmt::format("{} {} drive.c -lm -o drive.so 2> errors.txt", compiler, kFlags));
    EXPECT_EQ(code, 0) << read_file(folder_.path() / "errors.txt").value_or("");
    if (code != 0) return;
    library_ = dlopen((folder_.path() / "drive.so").c_str(), RTLD_NOW | RTLD_LOCAL);
    EXPECT_NE(library_, nullptr) << dlerror();
  }
  ~CDrive() {
    if (library_ != nullptr) dlclose(library_);
  }
  CDrive(const CDrive&) = delete;
  CDrive& operator=(const CDrive&) = delete;
  explicit operator bool() const { return library_ != nullptr; }

  std::vector<double> rates(double t, const std::vector<double>& y, const Input& u,
                            double torque_rate) const {
    using Rates = void(double, const double*, const Input*, double, double*, Output*);
    std::vector<double> dy(y.size());
    symbol_of<Rates>(library_, "drive_rates")(t, y.data(), &u, torque_rate, dy.data(), nullptr);
    return dy;
  }
  /// state: time, then the states.
  int step(std::vector<double>& state, const Input& from, const Input& to, double dt) const {
    using Step = int(double*, const Input*, const Input*, double);
    return symbol_of<Step>(library_, "drive_step")(state.data(), &from, &to, dt);
  }

 private:
  ExportFolder folder_;
  void* library_ = nullptr;
};

std::string_view form_of(Rig rig) {
  return rig == Rig::free ? "motor_driven" : rig == Rig::locked ? "inertial" : "torque_driven";
}

/// States of a moving, twisted drive with some memory.
std::vector<double> some_states(const RigSystem& system, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<double> y(system.states());
  for (std::size_t k = 0; k < y.size(); ++k) y[k] = 1e-4 * unit(random);
  const auto variables = system.variables();
  for (std::size_t k = 0; k < variables.size(); ++k) {
    if (variables[k].name == "motor_angle") y[k] = 0.1 * unit(random);
    if (variables[k].name == "motor_speed") y[k] = 20.0 * unit(random);
    if (variables[k].name == "load_angle") y[k] = 2e-3 * unit(random);
    if (variables[k].name == "load_speed") y[k] = 0.4 * unit(random);
  }
  return y;
}

void expect_same_rates(const RigModel& model, const std::string& words,
                       const std::string& compiler = "gcc") {
  const CDrive c(model, compiler);
  ASSERT_TRUE(c) << words;
  const double slope = 0.7;
  RigInputs inputs;
  inputs.channels[Quantity::motor_torque] = {[](double t) { return 0.3 + 0.7 * (t - 1.3); },
                                             [=](double) { return slope; }};
  inputs.load_torque = constant(2.0);
  const auto system = made_rig(model, inputs, form_of(model.rig));
  const auto p = system->parameter_vector();
  std::mt19937 random(7);
  for (int k = 0; k < 20; ++k) {
    const auto y = some_states(*system, random);
    std::vector<double> expected(y.size());
    system->rate(1.3, y, p, expected);
    const auto got = c.rates(1.3, y, {0.3, 2.0}, slope);
    for (std::size_t i = 0; i < y.size(); ++i) {
      EXPECT_NEAR(got[i], expected[i], kDifference * (std::abs(expected[i]) + 1.0))
          << words << " " << i;
    }
  }
}

class OnARig : public testing::TestWithParam<Rig> {};

TEST_P(OnARig, RatesOfTheBaselineAreOurs) {
  if (!there_is("gcc")) GTEST_SKIP() << "there is no gcc";
  expect_same_rates(example_model(GetParam()), "gcc");
  if (there_is("clang")) expect_same_rates(example_model(GetParam()), "clang", "clang");
}

// Every effect that the exporter does not refuse, all of a rig in one model and its memory behind
// it.
TEST_P(OnARig, RatesOfEveryEffectAreOurs) {
  if (!there_is("gcc")) GTEST_SKIP() << "there is no gcc";
  RigModel model = example_model(GetParam());
  std::size_t carried_effects = 0;
  for (const EffectRow& row : effects()) {
    if (std::ranges::find(row.rigs, model.rig) == row.rigs.end()) continue;
    if (on_instrument(row.site)) continue;
    EffectSpec effect{std::string(row.id), {}};
    for (const EffectParameter& one : row.parameters) {
      effect.parameters.emplace_back(one.name, one.nominal);
    }
    if (!no_c_effect(row, effect).empty()) continue;
    if (model.rig == Rig::servo && row.site == Site::kinematics) continue;
    model.drive.torsion.effects.push_back(effect);
    ++carried_effects;
  }
  EXPECT_GT(carried_effects, 12u);
  expect_same_rates(model, "all");
  claims::expect("docs/export.md", "c-rates", {{"difference", kDifference}});
}

TEST_P(OnARig, FrictionAcrossTheGearIsOurs) {
  if (!there_is("gcc")) GTEST_SKIP() << "there is no gcc";
  RigModel model = example_model(GetParam());
  model.drive.torsion.effects.push_back(
      {"stribeck_friction",
       {{"excess", 3.0}, {"stribeck_speed", 0.01}, {"exponent", 2.0}, {"smoothing", 1e-3}},
       "",
       true});
  expect_same_rates(model, "across");
}

INSTANTIATE_TEST_SUITE_P(Export, OnARig, testing::Values(Rig::free, Rig::locked, Rig::servo));

// From sample to sample under an input in straight lines: CVODES starts anew at each, so that both
// see the same input.
TEST(ExportC99, StepsGoWhereOurIntegrationGoes) {
  if (!there_is("gcc")) GTEST_SKIP() << "there is no gcc";
  const RigModel model = example_model(Rig::free);
  const CDrive c(model);
  ASSERT_TRUE(c);
  constexpr double kStep = 1e-3;
  constexpr int kSteps = 1500;
  const auto torque = [](int k) { return 0.4 * std::sin(2.0 * k * kStep) + 0.2; };
  std::vector<double> state(5, 0.0);
  std::vector<double> y(4, 0.0);
  for (int k = 0; k < kSteps; ++k) {
    ASSERT_EQ(c.step(state, {torque(k), 0.0}, {torque(k + 1), 0.0}, kStep), 0);
    RigInputs inputs;
    const double rise = (torque(k + 1) - torque(k)) / kStep;
    inputs.channels[Quantity::motor_torque] = {
        [=](double t) { return torque(k) + rise * (t - k * kStep); }, [=](double) { return rise; }};
    const auto system = made_rig(model, inputs, "motor_driven");
    y = later(*system, k * kStep, (k + 1) * kStep, y, 1e-12);
  }
  EXPECT_GT(std::abs(y[0]), 1.0) << "it moves";
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(state[i + 1], y[i], kDifference * std::max(1.0, std::abs(y[i]))) << i;
  }
  claims::expect("docs/export.md", "c-steps", {{"steps", kSteps}});
}

// A drive that follows a desired motion exactly needs exactly that torque: J1 N a + friction +
// load/N.
TEST(ExportC99, FeedForwardIsTheTorqueOfTheRigidMotionWithTheTorsionOfItsLoad) {
  if (!there_is("gcc")) GTEST_SKIP() << "there is no gcc";
  RigModel model = example_model(Rig::free);
  model.drive.load_mass = 0.0;
  ExportFolder folder;
  write_export("c99", model, folder);
  ASSERT_EQ(folder.run(fmt::format("gcc {} drive.c -lm -o drive.so", kFlags)), 0);
  void* library = dlopen((folder.path() / "drive.so").c_str(), RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(library, nullptr);
  const double desired[] = {0.3, 0.5, 4.0, 0.0, 1.0};  // angle, speed, acceleration, jerk, load
  double angle = 0.0;
  double torque = 0.0;
  using FeedForward = void(const double*, double*, double*);
  symbol_of<FeedForward>(library, "drive_feed_forward")(desired, &angle, &torque);
  dlclose(library);
  const DriveSpec& d = model.drive;
  const double load = d.load_inertia * 4.0 + d.load_viscous * 0.5 + 1.0;
  const double phi = angle / d.gear_ratio - 0.3;
  EXPECT_NEAR((*make_law(d.torsion.f))->value(phi), load, 1e-9 * load);
  const double speed = 0.5 * d.gear_ratio;
  const double expected = d.motor_inertia * d.gear_ratio * 4.0 + d.motor_viscous * speed +
                          d.motor_coulomb * std::tanh(speed / d.coulomb_width) +
                          load / d.gear_ratio;
  EXPECT_NEAR(torque, expected, 1e-12);
}

}  // namespace
}  // namespace flexspline::data
