// A specimen, driven by torque and by motion; moved, as a differential equation.
#include <numbers>

#include "flexspline/core/law.hpp"
#include "flexspline/core/simulate.hpp"
#include "flexspline/core/torque_signal.hpp"
#include "motions.hpp"
#include "rig_examples.hpp"

namespace flexspline {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// (2 pi/w) sum_k b_k (A w)^(2k) (2k-1)!!/(2k)!!: the work of a sine of motion over a cycle.
TEST(MovedSpecimen, LosesTheEnergyOfTheClosedForm) {
  DriveSpec drive = example_drive();
  drive.torsion.h = law_spec("bounded_modulation", 1.0, {}, {});
  for (const double amplitude : {5e-4, 2e-3, 4e-3}) {
    for (const double frequency : {0.3, 2.0, 7.0}) {
      const auto rig =
          made_rig(Rig::specimen, drive, {{{Quantity::angle, sine(amplitude, frequency)}}, {}},
                   "displacement_driven");
      const auto times = instants(1.0 / frequency, 4);
      const auto y = simulated(*rig, rig->parameter_vector(), times, rig->rest(), 1e-12, 1e-15);
      const double v = amplitude * kTurn * frequency / 0.05;
      const double closed =
          kTurn * amplitude * (3.0 * v * (1.0 / 2.0) + 1.0 * v * v * v * (3.0 / 8.0));
      EXPECT_NEAR(y.back() / closed, 1.0, 2e-9) << amplitude << " rad, " << frequency << " Hz";
    }
  }
}

// What a bench would record of it is what simulate_torque says, instrument and all.
TEST(MovedSpecimen, IsRecordedAsItsSamplesAre) {
  DriveSpec drive = example_drive();
  drive.torsion.effects = {
      {"bouc_wen", {{"height", 4.5}, {"slip_length", 3e-4}, {"exponent", 1.4}}},
      {"torque_sensor_gain", {{"gain", 0.02}}},
      {"inertia_torque", {{"inertia", 0.3}}}};
  drive.gear_ratio = 1.0;
  const Signal motion = sine(2e-3, 1.0);
  const auto rig = made_rig(Rig::specimen, drive, {{{Quantity::displacement, motion}}, {}},
                            "displacement_driven");
  const auto times = instants(2.0, 800);
  const auto p = rig->parameter_vector();
  const auto y = simulated(*rig, p, times, rig->rest(), 1e-11, 1e-14);
  const auto record = record_of(rig_row(Rig::specimen), *rig, p, times, y);
  ASSERT_TRUE(record) << record.error().message();
  Motion samples;
  for (const double t : times) {
    samples.time.push_back(t);
    samples.position.push_back(motion.value(t));
    samples.velocity.push_back(motion.rate(t));
    samples.acceleration.push_back(-kTurn * kTurn * motion.value(t));
  }
  const auto torque = simulate_torque(drive.torsion, samples);
  ASSERT_TRUE(torque) << torque.error().message();
  const auto& shown = record->channels.at(Quantity::transmitted_torque);
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_NEAR(shown[i], (*torque)[i], 1e-8 * 30.0) << times[i];
    EXPECT_NEAR(record->channels.at(Quantity::torsion)[i], samples.position[i], 1e-15);
  }
}

TEST(MovedSpecimen, SaysWhatItLacks) {
  const auto rig = make_rig(Rig::specimen, example_drive(), {}, "displacement_driven");
  ASSERT_FALSE(rig);
  EXPECT_THAT(rig.error().message(), testing::HasSubstr("torsion"));
}

/// Analytic torque that moves a specimen along A sin wt + B sin 3wt.
struct Imposed {
  ModelSpec model;
  double amplitude;
  double w;
  double motion(double t) const {
    return amplitude * (std::sin(w * t) + 0.2 * std::sin(3.0 * w * t));
  }
  double speed(double t) const {
    return amplitude * w * (std::cos(w * t) + 0.6 * std::cos(3.0 * w * t));
  }
  Signal torque() const {
    const auto f = std::shared_ptr<Law>(make_law(model.f).value());
    const auto g_inverse = std::shared_ptr<Law>(make_law(model.g_inverse).value());
    const auto h = std::shared_ptr<Law>(make_law(model.h).value());
    return {[=, self = *this](double t) {
              const double phi = self.motion(t);
              return f->value(phi) + g_inverse->value(self.speed(t) / h->value(phi));
            },
            {}};
  }
};

TEST(Specimen, GivesBackTheMotionThatMadeTheTorque) {
  DriveSpec drive = example_drive();
  drive.gear_ratio = 1.0;
  const Imposed imposed{drive.torsion, 2e-3, 2.0 * std::numbers::pi};
  const auto rig =
      made_rig(Rig::specimen, drive, {{{Quantity::transmitted_torque, imposed.torque()}}, {}});
  const auto times = instants(3.0, 300);
  const auto y = simulated(*rig, rig->parameter_vector(), times, rig->rest(), 1e-11, 1e-14);
  double worst = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    worst = std::max(worst, std::abs(y[i] - imposed.motion(times[i])));
  }
  std::printf("specimen, there and back: %.2e of the range\n", worst / 2e-3);
  EXPECT_LT(worst, 1e-8 * 2e-3);
}

// How far the motion that a torque makes is from the one it was made of. Share of the range.
double back_again(const ModelSpec& model, const Motion& motion, const auto& torque, double relative,
                  double absolute) {
  const auto torsion =
      simulate_torsion(model, motion.time, torque, 0.0, {relative, absolute, 5000000});
  EXPECT_TRUE(torsion) << torsion.error().message();
  if (!torsion) return std::nan("");
  double worst = 0.0;
  for (std::size_t i = 0; i < torsion->size(); ++i) {
    worst = std::max(worst, std::abs((*torsion)[i] - motion.position[i]));
  }
  return worst / 2e-3;
}

// With memory: torque along finely sampled motion and back.
double round_trip(std::vector<EffectSpec> effects, int per_cycle) {
  ModelSpec model = example_drive().torsion;
  model.effects = std::move(effects);
  Motion motion = harmonic_motion({2e-3}, per_cycle, 2);
  for (double& x : motion.position) x -= 2e-3;  // starts at zero, unloaded
  const auto torque = simulate_torque(model, motion);
  EXPECT_TRUE(torque) << torque.error().message();
  return back_again(model, motion, *torque, 1e-9, 1e-9);
}

TEST(Specimen, IsDrivenByTorqueWithItsMemory) {
  const std::vector<std::pair<std::string, std::vector<EffectSpec>>> cases = {
      {"presliding",
       {{"presliding_hysteresis",
         {{"stiffness", 2000.0}, {"yield", 3e-4}, {"stiffness", 1000.0}, {"yield", 1e-3}}}}},
      {"bouc_wen", {{"bouc_wen", {{"height", 4.5}, {"slip_length", 3e-4}, {"exponent", 1.0}}}}},
      {"creep", {{"viscoelastic_creep", {{"stiffness", 4500.0}, {"time_constant", 0.3}}}}},
      {"offset", {{"torque_sensor_offset", {{"offset", 0.5}}}}}};
  for (const auto& [name, effects] : cases) {
    const double error = round_trip(effects, 4000);
    std::printf("there and back with %s: %.2e of the range\n", name.c_str(), error);
    EXPECT_LT(error, 1e-5) << name;
  }
}

// The torque as a function of time has its corners where the slip elements have theirs, so that
// coarse samples of the motion come back as well as the integrator can. Three shares of amplitude:
// minor loops, turning points between the samples. Share of the range.
double round_trip_in_time(const EffectSpec& effect, int per_cycle) {
  ModelSpec model = example_drive().torsion;
  model.effects = {effect};
  Motion motion = harmonic_motion({1.2e-3, 0.7e-3, 0.5e-3}, per_cycle, 2);
  const double start = motion.position.front();
  for (double& x : motion.position) x -= start;
  const auto torque = torque_signal(model, motion);
  EXPECT_TRUE(torque) << torque.error().message();
  return back_again(model, motion, *torque, 1e-11, 1e-13);
}

TEST(Specimen, GivesBackTheMotionThatMadeTheTorqueOfSlipElements) {
  const EffectSpec slip{
      "presliding_hysteresis",
      {{"stiffness", 2000.0}, {"yield", 3e-4}, {"stiffness", 1000.0}, {"yield", 1e-3}}};
  for (const int per_cycle : {400, 4000}) {
    const double error = round_trip_in_time(slip, per_cycle);
    std::printf("slip elements, %d a cycle, there and back: %.2e of the range\n", per_cycle, error);
    EXPECT_LT(error, 1e-8);
  }
}

TEST(Specimen, GivesBackTheMotionThatMadeTheTorqueOfOtherMemories) {
  const std::vector<EffectSpec> memories = {
      {"dahl_hysteresis", {{"height", 4.5}, {"slip_length", 3e-4}}},
      {"viscoelastic_creep", {{"stiffness", 4500.0}, {"time_constant", 0.3}}}};
  for (const EffectSpec& memory : memories) {
    const double error = round_trip_in_time(memory, 400);
    std::printf("%s, 400 a cycle, there and back: %.2e of the range\n", memory.effect.c_str(),
                error);
    EXPECT_LT(error, 1e-8);
  }
}

// The other way round: the motion that a torque makes of slip elements asks for that torque.
TEST(Specimen, GivesBackTheTorqueThatMadeTheMotionOfSlipElements) {
  DriveSpec drive;
  drive.torsion = example_drive().torsion;
  drive.torsion.effects = {
      {"presliding_hysteresis",
       {{"stiffness", 2000.0}, {"yield", 3e-4}, {"stiffness", 1000.0}, {"yield", 1e-3}}}};
  const Signal given = sine(25.0, 1.0);
  const auto rig = made_rig(Rig::specimen, drive, {{{Quantity::transmitted_torque, given}}, {}});
  const auto times = instants(2.0, 8000);
  const auto y = simulated(*rig, rig->parameter_vector(), times, rig->rest(), 1e-11, 1e-15);
  const auto path = instants_along(*rig, rig->parameter_vector(), times, y);
  Motion motion;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::size_t before = i > 0 ? i - 1 : 0;
    const std::size_t after = std::min(i + 1, path.size() - 1);
    motion.time.push_back(times[i]);
    motion.position.push_back(path[i].motor_angle);
    motion.velocity.push_back(path[i].motor_speed);
    motion.acceleration.push_back((path[after].motor_speed - path[before].motor_speed) /
                                  (times[after] - times[before]));
  }
  const auto torque = torque_signal(drive.torsion, motion);
  ASSERT_TRUE(torque) << torque.error().message();
  double worst = 0.0;
  for (const double t : times) worst = std::max(worst, std::abs(torque->value(t) - given.value(t)));
  std::printf("slip elements, torque there and back: %.2e of its peak\n", worst / 25.0);
  EXPECT_LT(worst, 1e-8 * 25.0);
}

}  // namespace
}  // namespace flexspline
