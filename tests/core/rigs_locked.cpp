// The paper's bench and what rigs have in common; the energy of a specimen's loop.
#include <numbers>

#include "flexspline/core/simulate.hpp"
#include "motions.hpp"
#include "rig_examples.hpp"

namespace flexspline {
namespace {

LawSpec unity() { return law_spec("bounded_modulation", 1.0, {}, {}); }

/// Table I of Dhaouadi and Ghorbel (2003): coefficients b of g^-1 in Nm at 6.283e-3 deg/s.
std::vector<double> table_one_damping() {
  std::vector<double> b = {65.594, 5.571e7, -2.485e12, 5.615e16, -4.673e20};
  for (std::size_t k = 0; k < b.size(); ++k) {
    b[k] *= std::pow(6.283e-3, static_cast<double>(2 * k + 1));
  }
  return b;
}

// (2 pi/w) sum_k b_k (A w)^(2k) (2k-1)!!/(2k)!!: the energy a sine of motion loses; f drops out.
TEST(LoopEnergy, IsThatOfTheClosedForm) {
  const double edge = 6.283e-3 * std::numbers::pi / 180.0;
  ModelSpec model{.f = law_spec("odd_polynomial", 3.5e-3, {}, {4.8, 11.8}),
                  .g_inverse = law_spec("odd_polynomial", edge, {}, table_one_damping()),
                  .h = unity(),
                  .effects = {}};
  double worst = 0.0;
  for (double amplitude : {1e-3, 2e-3, 3.4907e-3, 5e-3}) {
    for (double frequency : {1e-3, 2.5e-3, 5e-3, 7e-3}) {
      constexpr int kSamples = 256;
      const double w = 2.0 * std::numbers::pi * frequency;
      Motion motion;
      for (int i = 0; i < kSamples; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kSamples;
        motion.time.push_back(angle / w);
        motion.position.push_back(amplitude * std::sin(angle));
        motion.velocity.push_back(amplitude * w * std::cos(angle));
        motion.acceleration.push_back(-amplitude * w * w * std::sin(angle));
      }
      const auto torque = simulate_torque(model, motion);
      ASSERT_TRUE(torque);
      double energy = 0.0;
      double size = 0.0;
      double closed = 0.0;
      for (std::size_t i = 0; i < torque->size(); ++i) {
        const double power = (*torque)[i] * motion.velocity[i] * 2.0 * std::numbers::pi / w;
        energy += power / kSamples;
        size += std::abs(power) / kSamples;
      }
      double factor = 1.0;
      for (std::size_t k = 1; k <= 5; ++k) {
        factor *= static_cast<double>(2 * k - 1) / static_cast<double>(2 * k);
        closed += model.g_inverse.coefficients[k - 1] *
                  std::pow(amplitude * w / edge, 2.0 * static_cast<double>(k) - 1.0) * amplitude *
                  w * factor;
      }
      closed *= 2.0 * std::numbers::pi / w;
      worst = std::max(worst, std::abs(energy - closed) / size);
      EXPECT_NEAR(energy, closed, 1e-10 * size) << amplitude << " rad, " << frequency << " Hz";
    }
  }
  std::printf("loop energy against the closed form: %.2e\n", worst);
}

// Inertia and the reduced form differ by what the inertia takes: nothing at slow excitation.
TEST(LockedRig, ApproachesTheReducedFormWhenSlow) {
  const DriveSpec drive = example_drive();
  double last = 1.0;
  for (double frequency : {2.0, 0.2, 0.02}) {
    const RigInputs inputs{{{Quantity::motor_torque, sine(0.6, frequency)}}, {}};
    const auto full = made_rig(Rig::locked, drive, inputs);
    const auto reduced = made_rig(Rig::locked, drive, inputs, "reduced");
    const auto times = instants(2.0 / frequency, 100);
    const auto y = simulated(*full, full->parameter_vector(), times, full->rest(), 1e-10, 1e-12);
    const auto z =
        simulated(*reduced, reduced->parameter_vector(), times, reduced->rest(), 1e-10, 1e-12);
    double worst = 0.0;
    double range = 0.0;
    for (std::size_t i = 10; i < times.size(); ++i) {
      worst = std::max(worst, std::abs(y[2 * i] - z[i]));
      range = std::max(range, std::abs(z[i]));
    }
    std::printf("locked against reduced at %g Hz: %.2e\n", frequency, worst / range);
    EXPECT_LT(worst / range, 0.2 * last);
    last = worst / range;
  }
  EXPECT_LT(last, 1e-5);
}

TEST(LockedRig, HoldsTheReferenceOfThePapersExperiment) {
  const DriveSpec drive = example_drive();
  const auto rig = made_rig(
      Rig::locked, drive, {{{Quantity::commanded_angle, sine(0.1745, 0.05)}}, {}}, "position_loop");
  const auto times = instants(40.0, 200);
  const auto y = simulated(*rig, rig->parameter_vector(), times, rig->rest(), 1e-8, 1e-10);
  for (std::size_t i = 20; i < times.size(); ++i) {
    const double wanted = 0.1745 * std::sin(2.0 * std::numbers::pi * 0.05 * times[i]);
    EXPECT_NEAR(y[3 * i], wanted, 0.02) << times[i];
  }
}

// The lag of the current lies between what the loop commands and what drives: commanded openly, the
// same torque makes the same motion.
TEST(LockedRig, LagsBehindItsPositionLoop) {
  DriveSpec drive = example_drive();
  drive.torsion.effects = {{"current_lag", {{"time_constant", 2e-3}}}};
  const auto held = made_rig(Rig::locked, drive,
                             {{{Quantity::commanded_angle, sine(0.17, 1.0)}}, {}}, "position_loop");
  const auto times = instants(1.0, 20000);
  const auto y = simulated(*held, held->parameter_vector(), times, held->rest(), 1e-10, 1e-12);
  const auto path = instants_along(*held, held->parameter_vector(), times, y);
  std::vector<double> commanded;
  for (const auto& x : path) commanded.push_back(x.motor_torque);
  const RigInputs torque{{{Quantity::motor_torque, sampled_signal(times, commanded)}}, {}};
  const auto open = made_rig(Rig::locked, drive, torque);
  const auto z = simulated(*open, open->parameter_vector(), times, open->rest(), 1e-10, 1e-12);
  drive.torsion.effects.clear();
  const auto quick = made_rig(Rig::locked, drive, torque);
  const auto w = simulated(*quick, quick->parameter_vector(), times, quick->rest(), 1e-10, 1e-12);
  double worst = 0.0;
  double lag = 0.0;
  double most = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    worst = std::max(worst, std::abs(y[4 * i] - z[3 * i]));
    lag = std::max(lag, std::abs(w[2 * i] - z[3 * i]));
    most = std::max(most, std::abs(y[4 * i]));
  }
  std::printf("lag in the loop and commanded openly: %.2e of the motion, without it %.2e\n",
              worst / most, lag / most);
  EXPECT_LT(worst, 1e-5 * most);
  EXPECT_GT(lag, 1e-3 * most);
}

// Eq. (11) at one state, by hand.
TEST(LockedRig, ObeysItsEquation) {
  const DriveSpec drive = example_drive();
  const auto rig = made_rig(Rig::locked, drive, {{{Quantity::motor_torque, constant(0.3)}}, {}});
  const double angle = 0.05;
  const double speed = 0.7;
  const auto x = rig->instant(0.0, std::vector<double>{angle, speed}, rig->parameter_vector());
  const double phi = angle / 50.0;
  const double rate = speed / 50.0;
  const double u = phi / 2e-3;
  const double h = std::exp(1.5 * std::tanh((0.1 * u + 0.2 * u * u) / 1.5));
  const double v = rate / h / 0.05;
  const double tau = 24.0 * u + 6.0 * u * u * u + 3.0 * v + v * v * v;
  EXPECT_NEAR(x.transmitted_torque, tau, 1e-12);
  const double left = reflected_torque(drive, 0.3, speed) - reflected_viscous(drive) * rate - tau;
  EXPECT_NEAR(reflected_inertia(drive) * x.torsion_acceleration, left, 1e-12);
}

std::string refusal(Rig rig, const DriveSpec& drive, const RigInputs& inputs,
                    std::string_view form = {}) {
  const auto system = make_rig(rig, drive, inputs, form);
  return system ? std::string() : system.error().message();
}

TEST(Rigs, RefuseWhatTheyCannotSimulate) {
  const RigInputs driven{{{Quantity::motor_torque, constant(0.0)}}, {}};
  DriveSpec drive = example_drive();
  EXPECT_THAT(refusal(Rig::free, drive, {}), testing::HasSubstr("no motor_torque"));
  EXPECT_THAT(refusal(Rig::free, drive, driven, "upside_down"), testing::HasSubstr("upside_down"));
  drive.load_inertia = 0.0;
  EXPECT_THAT(refusal(Rig::free, drive, driven), testing::HasSubstr("load_inertia is 0"));
  EXPECT_EQ(refusal(Rig::locked, drive, driven), "");
  drive.torsion.effects = {
      {"load_dependent_kinematic_error", {{"compliance", 3e-7}, {"order", 2.0}, {"phase", 0.0}}}};
  EXPECT_THAT(refusal(Rig::locked, drive, driven), testing::HasSubstr("negative compliance"));
  drive.torsion.effects.push_back({"series_compliance", {{"compliance", 4e-7}}});
  EXPECT_EQ(refusal(Rig::locked, drive, driven), "");
  drive.motor_viscous = 0.0;
  EXPECT_THAT(refusal(Rig::locked, drive, driven, "reduced"), testing::HasSubstr("motor_viscous"));
  drive.torsion.effects = {{"inertia_torque", {{"inertia", 1.0}}}};
  EXPECT_THAT(refusal(Rig::specimen, drive, {{{Quantity::torque, constant(0.0)}}, {}}),
              testing::HasSubstr("acceleration"));
}

/// A form of every rig in which all that is listed for it can be simulated, and what drives it.
struct WholeForm {
  Rig rig;
  std::string_view form;
  Quantity input;
};

constexpr WholeForm kWholeForms[] = {{Rig::locked, "inertial", Quantity::motor_torque},
                                     {Rig::free, "motor_driven", Quantity::motor_torque},
                                     {Rig::specimen, "displacement_driven", Quantity::torsion},
                                     {Rig::servo, "compliant", Quantity::motor_torque}};

// What the catalogue lists for a rig is simulated on it, and recorded.
TEST(Rigs, TakeEveryEffectThatIsListedForThem) {
  const EffectSpec spring{"series_compliance", {{"compliance", 4.8e-5}}};
  for (const auto& [rig, form, given] : kWholeForms) {
    const Signal signal = sine(given == Quantity::torsion ? 2e-3 : 0.4, 2.0);
    for (const EffectRow& row : effects()) {
      if (std::ranges::find(row.rigs, rig) == row.rigs.end()) continue;
      DriveSpec drive = example_drive();
      drive.torsion.effects = {{std::string(row.id), {}}};
      for (const auto& one : row.parameters) {
        drive.torsion.effects[0].parameters.emplace_back(std::string(one.name), one.nominal);
      }
      if (row.id == "load_dependent_kinematic_error") drive.torsion.effects.push_back(spring);
      const auto system = make_rig(rig, drive, {{{given, signal}}, {}}, form);
      ASSERT_TRUE(system) << row.id << ": " << system.error().message();
      const auto times = instants(0.02, 8);
      const auto p = (*system)->parameter_vector();
      const auto y = simulated(**system, p, times, (*system)->rest(), 1e-7, 1e-9);
      const auto record = record_of(rig_row(rig), **system, p, times, y);
      ASSERT_TRUE(record) << row.id << ": " << record.error().message();
      for (const auto& [quantity, values] : record->channels) {
        EXPECT_TRUE(std::ranges::all_of(values, [](double v) { return std::isfinite(v); }))
            << row.id << " on " << name_of(rig);
      }
    }
  }
}

TEST(Rigs, SayWhatTheyAre) {
  ASSERT_EQ(rigs().size(), 4u);
  for (const RigRow& row : rigs()) {
    EXPECT_EQ(row.id, name_of(row.rig));
    for (std::string_view text : {row.says, row.equations, row.not_modelled}) {
      EXPECT_FALSE(text.empty()) << row.id;
    }
    EXPECT_FALSE(row.outputs.empty());
    EXPECT_FALSE(row.residuals.empty());
    for (const RigForm& form : row.forms) {
      EXPECT_FALSE(form.says.empty());
      EXPECT_FALSE(form.inputs.empty());
    }
  }
}

TEST(DriveSpecs, GiveAndTakeTheirParametersInOneOrder) {
  DriveSpec drive = example_drive();
  drive.torsion.effects = {
      {"presliding_hysteresis",
       {{"stiffness", 2000.0}, {"yield", 3e-4}, {"stiffness", 1000.0}, {"yield", 1e-3}}}};
  const auto& constants = rig_row(Rig::free).constants;
  auto list = parameters_of(drive, constants);
  EXPECT_EQ(list[0].name, "f[0]");
  EXPECT_EQ(list.back().name, "presliding_hysteresis[1].yield");
  EXPECT_EQ(list.back().unit, "rad");
  std::vector<double> values;
  for (const auto& one : list) values.push_back(one.value + 1.0);
  const DriveSpec other = with_parameters(drive, constants, values);
  EXPECT_EQ(other.torsion.f.coefficients[0], drive.torsion.f.coefficients[0] + 1.0);
  EXPECT_EQ(other.motor_inertia, drive.motor_inertia + 1.0);
  list = parameters_of(other, constants);
  for (std::size_t k = 0; k < list.size(); ++k) EXPECT_EQ(list[k].value, values[k]) << list[k].name;
}

}  // namespace
}  // namespace flexspline
