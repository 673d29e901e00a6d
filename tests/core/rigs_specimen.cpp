// A specimen that is moved, as a differential equation.
#include <numbers>

#include "flexspline/core/simulate.hpp"
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

}  // namespace
}  // namespace flexspline
