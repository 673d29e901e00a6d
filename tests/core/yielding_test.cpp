// Kinematics that follow the torque: the law and what yields in series with it, solved together.
#include <cmath>
#include <complex>

#include "claims/claims.hpp"
#include "flexspline/core/simulate.hpp"
#include "flexspline/core/torque_signal.hpp"
#include "motions.hpp"
#include "rig_examples.hpp"

namespace flexspline {
namespace {

constexpr double kStiffness = 1.5e5;
constexpr double kCompliance = 4.8e-5;

ModelSpec line(double stiffness, double damping, std::vector<EffectSpec> effects) {
  return {.f = law_spec("odd_polynomial", 1e-3, {}, {1e-3 * stiffness}),
          .g_inverse = law_spec("odd_polynomial", 1e-3, {}, {1e-3 * damping}),
          .h = law_spec("bounded_modulation", 1.0, {}, {}),
          .effects = std::move(effects)};
}

EffectSpec series(double compliance) { return {"series_compliance", {{"compliance", compliance}}}; }

Motion small_motion(int per_cycle, int cycles) {
  return harmonic_motion({2e-3, 1e-3}, per_cycle, cycles);
}

TEST(SeriesCompliance, MakesOneSpringOfTwo) {
  const auto motion = small_motion(200, 1);
  const auto torque = simulate_torque(line(kStiffness, 0.0, {series(kCompliance)}), motion);
  ASSERT_TRUE(torque) << torque.error().message();
  const double both = 1.0 / (1.0 / kStiffness + kCompliance);
  for (std::size_t i = 0; i < torque->size(); ++i) {
    EXPECT_NEAR((*torque)[i], both * motion.position[i], 1e-10 * both * 3e-3);
  }
}

// 1/Z = 1/(K + i w D) + c once the start has died away; fourth order in the interval.
TEST(SeriesCompliance, FollowsTheThreeElementSolid) {
  constexpr double kDamping = 60.0;
  double last = 0.0;
  for (const int per_cycle : {250, 500, 1000}) {
    const auto motion = harmonic_motion({2e-3}, per_cycle, 3);
    const auto torque = simulate_torque(line(kStiffness, kDamping, {series(kCompliance)}), motion);
    ASSERT_TRUE(torque);
    const std::complex<double> dashpot(kStiffness, 2.0 * std::numbers::pi * kDamping);
    const std::complex<double> stiffness = 1.0 / (1.0 / dashpot + kCompliance);
    double worst = 0.0;
    for (std::size_t i = torque->size() / 2; i < torque->size(); ++i) {
      const double wanted =
          2e-3 * (stiffness * std::polar(1.0, 2.0 * std::numbers::pi * motion.time[i])).real();
      worst = std::max(worst, std::abs((*torque)[i] - wanted) / (2e-3 * std::abs(stiffness)));
    }
    std::printf("three-element solid, %d a cycle: %.2e\n", per_cycle, worst);
    if (last > 0.0) {
      EXPECT_GT(last / worst, 12.0);
    }
    last = worst;
    if (per_cycle == 250) claims::expect("docs/simulation.md", "solid-coarse", {{"250", worst}});
  }
  EXPECT_LT(last, 1e-10);
  claims::expect("docs/simulation.md", "solid-fine", {{"1000", last}});
}

constexpr double kGap = 1e-4;
constexpr double kFriction = 4.5;

double gap_at(double play) { return kGap * play / std::hypot(play, kFriction); }

// A spring with a joint in series, made by its torque: phi = tau/K + b p/sqrt(p^2 + T^2), p the
// play of the torque. Derivatives do not matter, as there is no damping.
Motion spring_and_joint(double amplitude, int samples, int cycles, std::vector<double>& torque) {
  Motion m;
  double play = 0.0;
  for (int i = 0; i <= samples * cycles; ++i) {
    const double t = static_cast<double>(i) / samples;
    const double tau = amplitude * std::sin(2.0 * std::numbers::pi * t);
    play = std::clamp(play, tau - kFriction, tau + kFriction);
    torque.push_back(tau);
    m.time.push_back(t);
    m.position.push_back(tau / kStiffness + gap_at(play));
    m.velocity.push_back(0.0);
    m.acceleration.push_back(0.0);
  }
  return m;
}

EffectSpec joint() { return {"play_backlash", {{"half_gap", kGap}, {"friction", kFriction}}}; }

TEST(PlayBacklash, InSeriesWithASpringGivesTheTorqueThatMadeTheMotion) {
  std::vector<double> wanted;
  const Motion motion = spring_and_joint(60.0, 2000, 2, wanted);
  const auto torque = simulate_torque(line(kStiffness, 0.0, {joint()}), motion);
  ASSERT_TRUE(torque) << torque.error().message();
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_NEAR((*torque)[i], wanted[i], 1e-10 * 60.0) << motion.time[i];
  }
  // Over a closed cycle the spring gives all back and the joint keeps four times T by its motion.
  const double lost = work(motion, *torque, 2000, 4000);
  EXPECT_NEAR(lost, 4.0 * kFriction * gap_at(60.0 - kFriction), 1e-5 * lost);
}

TEST(SimulateTorque, SaysWhereKinematicsLeaveNoTorque) {
  const auto motion = small_motion(200, 1);
  const EffectSpec wave{"load_dependent_kinematic_error",
                        {{"compliance", 1e-3}, {"order", 200.0}, {"phase", 0.5}}};
  const auto torque = simulate_torque(line(kStiffness, 0.0, {wave}), motion);
  ASSERT_FALSE(torque);
  EXPECT_EQ(torque.error().code, ErrorCode::numerics);
  EXPECT_THAT(torque.error().message(), testing::HasSubstr("no torque goes with the motion"));
}

// A (1 - cos wt)^2: the first three derivatives start at zero.
Motion soft_start(double amplitude, int per_cycle) {
  constexpr double w = 2.0 * std::numbers::pi;
  Motion m;
  for (int i = 0; i <= 2 * per_cycle; ++i) {
    const double t = static_cast<double>(i) / per_cycle;
    const double c = std::cos(w * t);
    const double s = std::sin(w * t);
    m.time.push_back(t);
    m.position.push_back(amplitude * (1.0 - c) * (1.0 - c));
    m.velocity.push_back(2.0 * amplitude * w * (1.0 - c) * s);
    m.acceleration.push_back(2.0 * amplitude * w * w * (s * s + (1.0 - c) * c));
  }
  return m;
}

double fastest(const std::vector<double>& time, const std::vector<double>& values) {
  double most = 0.0;
  for (std::size_t i = 1; i < time.size(); ++i) {
    most = std::max(most, std::abs(values[i] - values[i - 1]) / (time[i] - time[i - 1]));
  }
  return most;
}

/// s by which a rig's joint lags behind its torque, so that it can be integrated.
constexpr double kCreep = 1e-5;

// Eq. (3) and eq. (4) undo each other with what yields in series too, sample by sample; a rig's
// joint, which creeps, only to its lag. As rigs, joint and all: inverse_test.
TEST(SeriesCompliance, GivesBackTheMotionThatMadeTheTorque) {
  for (const bool plays : {false, true}) {
    ModelSpec model = example_drive().torsion;
    model.effects = {plays ? joint() : series(kCompliance)};
    const Motion motion = soft_start(1e-3, 8000);
    const auto torque = simulate_torque(model, motion);
    ASSERT_TRUE(torque) << torque.error().message();
    const auto torsion =
        simulate_torsion(model, motion.time, *torque, 0.0, {1e-11, 1e-13, 5000000});
    ASSERT_TRUE(torsion) << torsion.error().message();
    double worst = 0.0;
    for (std::size_t i = 0; i < torsion->size(); ++i) {
      worst = std::max(worst, std::abs((*torsion)[i] - motion.position[i]));
    }
    std::printf("there and back in series with a %s: %.2e of the range\n",
                plays ? "joint" : "spring", worst / 2e-3);
    const double lag = kCreep * kGap * fastest(motion.time, *torque) / kFriction;
    EXPECT_LT(worst, plays ? lag : 1e-8 * 2e-3);
    if (plays) claims::expect("docs/simulation.md", "creeping-joint", {{"joint", worst / 2e-3}});
  }
}

// The locked rig's own motion, imposed, asks for the torque that the rig transmits.
TEST(LockedRig, YieldsInSeriesAsTheImposedMotionDoes) {
  for (const bool plays : {false, true}) {
    DriveSpec drive = example_drive();
    drive.torsion.effects = {plays ? joint() : series(kCompliance)};
    const auto rig = made_rig(Rig::locked, drive, {{{Quantity::motor_torque, sine(0.5, 1.0)}}, {}});
    ASSERT_EQ(rig->states(), 3u);
    const auto times = instants(1.0, 8000);
    const auto y = simulated(*rig, rig->parameter_vector(), times, rig->rest(), 1e-10, 1e-13);
    const auto path = instants_along(*rig, rig->parameter_vector(), times, y);
    Motion motion;
    double peak = 0.0;
    for (const auto& x : path) {
      motion.time.push_back(x.time);
      motion.position.push_back(x.motor_angle / x.gear_ratio);
      motion.velocity.push_back(x.motor_speed / x.gear_ratio);
      motion.acceleration.push_back(x.motor_acceleration / x.gear_ratio);
      peak = std::max(peak, std::abs(x.transmitted_torque));
    }
    const auto torque = simulate_torque(drive.torsion, motion);
    ASSERT_TRUE(torque) << torque.error().message();
    double worst = 0.0;
    for (std::size_t i = 0; i < path.size(); ++i) {
      worst = std::max(worst, std::abs((*torque)[i] - path[i].transmitted_torque) / peak);
    }
    std::printf("locked rig in series with a %s against the imposed motion: %.2e of %.3g Nm\n",
                plays ? "joint" : "spring", worst, peak);
    EXPECT_LT(worst, plays ? 1e-3 : 1e-7);
  }
}

// Without inertia the reduced form is the limit of the inertial one, compliance and all.
TEST(LockedRig, ReducesWithComplianceInSeries) {
  DriveSpec drive = example_drive();
  drive.motor_inertia = 1e-9;
  drive.torsion.effects = {series(kCompliance)};
  const RigInputs inputs{{{Quantity::motor_torque, sine(0.4, 0.5)}}, {}};
  const auto times = instants(2.0, 40);
  const auto full = made_rig(Rig::locked, drive, inputs);
  const auto reduced = made_rig(Rig::locked, drive, inputs, "reduced");
  const auto a = simulated(*full, full->parameter_vector(), times, full->rest(), 1e-9, 1e-12);
  const auto b =
      simulated(*reduced, reduced->parameter_vector(), times, reduced->rest(), 1e-9, 1e-12);
  double size = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) size = std::max(size, std::abs(b[2 * i]));
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(a[3 * i], b[2 * i], 1e-5 * size);
}

}  // namespace
}  // namespace flexspline
