#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <complex>
#include <set>

#include "dataset_fixture.hpp"
#include "flexspline/data/dataset.hpp"
#include "hidden_fixture.hpp"

namespace flexspline::data {
namespace {

constexpr Rig kRigs[] = {Rig::locked, Rig::free, Rig::specimen, Rig::servo};

/// A bench as it is drawn, with fewer recordings and samples.
HiddenBench short_bench(Rig rig, std::uint64_t seed) {
  HiddenBench bench = draw_hidden_bench(rig, seed);
  bench.design.resize(4);
  for (HiddenExcitation& excitation : bench.design) excitation.samples = 150;
  return bench;
}

std::vector<HiddenEffect> pair_for(Rig rig) {
  if (rig == Rig::specimen) return {{"presliding_hysteresis", 0.04}, {"inertia_torque", 0.03}};
  return {{"stribeck_friction", 0.04}, {"motor_torque_offset", 0.03}};
}

TEST(HiddenSet, IsTheSameAgainAndInAnyOrder) {
  for (const Rig rig : kRigs) {
    HiddenBench bench = short_bench(rig, 5);
    std::vector<HiddenEffect> effects = pair_for(rig);
    const auto first = run_hidden_bench(bench, effects).value();
    EXPECT_TRUE(same_bits(first.measured, run_hidden_bench(bench, effects).value().measured));
    std::ranges::reverse(effects);
    std::ranges::reverse(bench.design);
    auto other = run_hidden_bench(bench, effects).value();
    std::ranges::reverse(other.measured.recordings);
    EXPECT_TRUE(same_bits(first.measured, other.measured)) << name_of(rig);
    EXPECT_EQ(first.answer.effects.size(), 2U);
    bench.seed = 6;
    EXPECT_FALSE(same_bits(first.measured, run_hidden_bench(bench, effects).value().measured));
  }
}

class HiddenFolderTest : public InFolder {};

TEST_F(HiddenFolderTest, ReadsBackWithoutANote) {
  for (const Rig rig : kRigs) {
    const RecordingSet set = run_hidden_bench(short_bench(rig, 8), pair_for(rig)).value().measured;
    const auto folder = folder_ / std::string(name_of(rig));
    ASSERT_TRUE(write_dataset(folder, set));
    const DatasetReading reading = read_dataset(folder);
    for (const Finding& error : reading.errors) ADD_FAILURE() << error.message();
    for (const Finding& note : reading.notes) ADD_FAILURE() << note.message();
    ASSERT_TRUE(reading.set);
    EXPECT_EQ(reading.set->rig, rig);
    EXPECT_EQ(reading.set->constants, set.constants);
    ASSERT_EQ(reading.set->recordings.size(), set.recordings.size());
    for (std::size_t i = 0; i < set.recordings.size(); ++i) {
      const Recording& put = set.recordings[i];
      const Recording& got = reading.set->recordings[i];
      EXPECT_EQ(got.start_s, put.start_s);
      for (const auto& [quantity, values] : put.channels) {
        for (std::size_t k = 0; k < values.size(); ++k) {
          ASSERT_NEAR(got.channels.at(quantity)[k], values[k], 1e-14 * (1.0 + std::abs(values[k])));
        }
      }
    }
  }
}

double rms_gap(const RecordingSet& a, const RecordingSet& b, Quantity quantity) {
  double square = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < a.recordings.size(); ++i) {
    const auto& x = a.recordings[i].channels.at(quantity);
    const auto& y = b.recordings[i].channels.at(quantity);
    for (std::size_t k = 0; k < x.size(); ++k) square += (x[k] - y[k]) * (x[k] - y[k]);
    count += static_cast<double>(x.size());
  }
  return std::sqrt(square / count);
}

TEST(HiddenNoise, HasTheStatedSize) {
  HiddenBench bench = small_bench(Rig::locked);
  bench.nuisances = {.torque_noise = 0.005, .coloured_share = 0.3, .coloured_samples = 5.0};
  for (HiddenExcitation& excitation : bench.design) excitation.samples = 4000;
  const auto made = run_hidden_bench(bench, {}).value();
  EXPECT_DOUBLE_EQ(made.answer.noise_std, 0.005 * made.answer.peak_torque);
  EXPECT_DOUBLE_EQ(made.answer.motor_noise_std, 0.005 * made.answer.peak_motor_torque);
  // 12000 samples; the coloured part has a fifth as many independent squares: 2 % is four sigma.
  const double torque = rms_gap(made.measured, made.ideal, Quantity::transmitted_torque);
  const double motor = rms_gap(made.measured, made.ideal, Quantity::motor_torque);
  EXPECT_NEAR(torque / made.answer.noise_std, 1.0, 0.04);
  EXPECT_NEAR(motor / made.answer.motor_noise_std, 1.0, 0.04);
  EXPECT_EQ(rms_gap(made.measured, made.ideal, Quantity::motor_angle), 0.0);
}

TEST(HiddenEncoders, CountAndAreOffByTheirZero) {
  HiddenBench bench = small_bench(Rig::free);
  const double step = 6.28e-5;
  bench.nuisances = {.motor_encoder_step = step, .load_encoder_step = 1e-6, .angle_zero = 2e-4};
  const auto made = run_hidden_bench(bench, {}).value();
  const auto& counted = made.measured.recordings[0].channels.at(Quantity::motor_angle);
  const auto& angle = made.ideal.recordings[0].channels.at(Quantity::motor_angle);
  for (std::size_t k = 0; k < angle.size(); ++k) {
    ASSERT_NEAR(counted[k] / step, std::round(counted[k] / step), 1e-6);
    ASSERT_LE(std::abs(counted[k] - angle[k] - 50.0 * 2e-4), 0.5001 * step);
  }
}

TEST(HiddenSensor, IsOffByItsOffset) {
  HiddenBench bench = small_bench(Rig::free);
  bench.nuisances = {.torque_noise = 0.005, .torque_offset = 0.1};
  const auto off = run_hidden_bench(bench, {}).value();
  bench.nuisances.torque_offset = 0.0;
  const auto right = run_hidden_bench(bench, {}).value();
  const auto& a = off.measured.recordings[0].channels;
  const auto& b = right.measured.recordings[0].channels;
  for (std::size_t k = 0; k < a.at(Quantity::transmitted_torque).size(); ++k) {
    ASSERT_NEAR(a.at(Quantity::transmitted_torque)[k] - b.at(Quantity::transmitted_torque)[k],
                0.1 * off.answer.noise_std, 1e-12);
  }
  EXPECT_EQ(a.at(Quantity::motor_torque), b.at(Quantity::motor_torque));
}

TEST(HiddenMotorTorque, IsOffByItsOffset) {
  HiddenBench bench = small_bench(Rig::locked);
  bench.nuisances = {.torque_noise = 0.005, .motor_torque_offset = -0.1};
  const auto off = run_hidden_bench(bench, {}).value();
  bench.nuisances.motor_torque_offset = 0.0;
  const auto right = run_hidden_bench(bench, {}).value();
  const auto& a = off.measured.recordings[0].channels;
  const auto& b = right.measured.recordings[0].channels;
  for (std::size_t k = 0; k < a.at(Quantity::motor_torque).size(); ++k) {
    ASSERT_NEAR(a.at(Quantity::motor_torque)[k] - b.at(Quantity::motor_torque)[k],
                -0.1 * off.answer.motor_noise_std, 1e-12);
  }
  EXPECT_EQ(a.at(Quantity::transmitted_torque), b.at(Quantity::transmitted_torque));
}

TEST(HiddenZero, MovesFromRecordingToRecording) {
  HiddenBench bench = small_bench(Rig::specimen);
  bench.nuisances = {.angle_zero = 1e-4, .zero_spread = 2e-5};
  const auto made = run_hidden_bench(bench, {}).value();
  std::set<double> zeros;
  for (std::size_t i = 0; i < made.ideal.recordings.size(); ++i) {
    const auto& shown = made.measured.recordings[i].channels.at(Quantity::torsion);
    const auto& angle = made.ideal.recordings[i].channels.at(Quantity::torsion);
    const double zero = shown[0] - angle[0];
    EXPECT_NEAR(zero, 1e-4, 2e-5);
    zeros.insert(zero);
    for (std::size_t k = 0; k < angle.size(); ++k) ASSERT_NEAR(shown[k] - angle[k], zero, 1e-15);
  }
  EXPECT_EQ(zeros.size(), made.ideal.recordings.size());
}

/// Temperatures by least squares, to first order in them, from what the motor's balance lacks:
/// (exp(-a T) - 1) B w + (exp(-b T) - 1) tc sgn w. Grease first, dry friction second.
std::array<double, 2> temperatures(const HiddenBench& bench, const Recording& r) {
  const auto left = balance(bench, HiddenEquation::motor, r);
  const Differences angle = series(r, Quantity::motor_angle);
  double m[2][2] = {};
  double v[2] = {};
  for (std::size_t k = 0; k < left.size(); ++k) {
    const double rate = angle.first(k + 2);
    const double column[] = {bench.gear.motor_drag * rate, coulomb(bench.gear, rate)};
    for (int i = 0; i < 2; ++i) {
      v[i] += column[i] * left[k];
      for (int j = 0; j < 2; ++j) m[i][j] += column[i] * column[j];
    }
  }
  const double det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  const double viscous = (m[1][1] * v[0] - m[0][1] * v[1]) / det;
  const double dry = (m[0][0] * v[1] - m[1][0] * v[0]) / det;
  return {-std::log1p(viscous) / 0.035, -std::log1p(dry) / 0.01};
}

// Each recording has a temperature of its own, within the spread, that all its friction follows.
TEST(HiddenTemperature, ScattersTheFrictionFromRecordingToRecording) {
  HiddenBench bench = small_bench(Rig::free);
  bench.nuisances = {.temperature_spread = 5.0};
  const auto made = run_hidden_bench(bench, {}).value();
  std::set<double> drawn;
  for (const Recording& r : made.ideal.recordings) {
    const auto [grease, dry] = temperatures(bench, r);
    EXPECT_NEAR(grease, dry, 0.05) << r.id;
    EXPECT_LE(std::abs(grease), 5.05) << r.id;
    drawn.insert(std::round(10.0 * grease));
  }
  EXPECT_EQ(drawn.size(), made.ideal.recordings.size());
}

// An effect is sized against the friction of its own recording.
TEST(HiddenTemperature, DoesNotCountAsAnEffect) {
  HiddenBench bench = small_bench(Rig::free);
  const auto cold = run_hidden_bench(bench, {{"stribeck_friction", 0.04}}).value();
  bench.nuisances = {.temperature_spread = 20.0};
  const auto warm = run_hidden_bench(bench, {{"stribeck_friction", 0.04}}).value();
  EXPECT_NEAR(warm.answer.effects[0].parameters[0].value,
              cold.answer.effects[0].parameters[0].value,
              0.1 * cold.answer.effects[0].parameters[0].value);
}

// What the kinematics return to the motor is tau de/dth1: what the motor's balance lacks, projected
// on tau exp(2 i th1), is the amplitude of order 2.
TEST(HiddenKinematics, ReturnTheirWorkToTheMotor) {
  const HiddenBench bench = small_bench(Rig::free);
  const auto with = run_hidden_bench(bench, {{"kinematic_error", 0.2}}).value();
  std::complex<double> sum = 0.0;
  double squares = 0.0;
  for (const Recording& r : with.ideal.recordings) {
    const auto left = balance(bench, HiddenEquation::motor, r);
    for (std::size_t k = 0; k < left.size(); ++k) {
      const double tau = r.channels.at(Quantity::transmitted_torque)[k + 2];
      const double angle = r.channels.at(Quantity::motor_angle)[k + 2];
      sum += left[k] * tau * std::polar(1.0, -2.0 * angle);
      squares += tau * tau;
    }
  }
  const double error = with.answer.effects[0].parameters[0].value;
  std::printf("returned over expected: %.3f\n", std::abs(sum) / squares / error);
  EXPECT_NEAR(std::abs(sum) / squares / error, 1.0, 0.15);
}

TEST(HiddenDraw, AsksOfAGearWhatItIsRatedFor) {
  double least = 10.0;
  double most = 0.0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const HiddenBench bench = draw_hidden_bench(Rig::free, seed);
    const auto made = run_hidden_bench(bench, {});
    ASSERT_TRUE(made) << made.error().message();
    const double share = made->answer.peak_torque / bench.gear.rated_torque;
    least = std::min(least, share);
    most = std::max(most, share);
    EXPECT_LE(std::abs(bench.nuisances.torque_offset), 0.1);
    EXPECT_LE(std::abs(bench.nuisances.angle_zero),
              0.1 * bench.nuisances.torque_noise * bench.gear.rated_torsion);
    EXPECT_NE(bench.nuisances.torque_offset, 0.0);
    EXPECT_NE(bench.nuisances.angle_zero, 0.0);
    EXPECT_LE(std::abs(bench.nuisances.motor_torque_offset), 0.1);
    EXPECT_NE(bench.nuisances.motor_torque_offset, 0.0);
    EXPECT_GE(bench.nuisances.temperature_spread, 0.3);
    EXPECT_LE(bench.nuisances.temperature_spread, 0.9);
  }
  std::printf("drawn free benches peak at %.2f to %.2f of the rated torque\n", least, most);
  EXPECT_GT(least, 0.8);
  EXPECT_LE(most, 1.06);
}

TEST(HiddenDraw, StaysInItsRanges) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    for (const Rig rig : kRigs) {
      const HiddenBench bench = draw_hidden_bench(rig, seed);
      const HiddenGear& gear = bench.gear;
      EXPECT_GE(bench.nuisances.torque_noise, 0.003);
      EXPECT_LE(bench.nuisances.torque_noise, 0.006);
      EXPECT_GE(bench.design.size(), 8U);
      EXPECT_LE(bench.design.size(), 11U);
      double last_f = -1e300;
      double last_g = -1e300;
      for (int k = -300; k <= 300; ++k) {
        const double phi = 0.01 * k * gear.rated_torsion;
        const double rate = 0.1 * k * gear.rated_torsion;
        EXPECT_GT(gear.stiffness(phi), last_f) << gear.families;
        EXPECT_GT(gear.damping(rate), last_g) << gear.families;
        EXPECT_EQ(gear.stiffness(-phi), -gear.stiffness(phi));
        EXPECT_EQ(gear.damping(-rate), -gear.damping(rate));
        EXPECT_EQ(gear.modulation(phi), gear.modulation(-phi));
        EXPECT_GE(gear.modulation(phi), 1.0);
        EXPECT_LE(gear.modulation(phi), 1.6);
        last_f = gear.stiffness(phi);
        last_g = gear.damping(rate);
      }
    }
  }
}

/// On a locked output, f and g^-1 share the work of a steady sine as the residual law says: the
/// loop's area is that of g^-1 alone.
TEST(HiddenNull, LosesWhatItsDampingTakes) {
  const HiddenBench bench = small_bench(Rig::specimen);
  const auto made = run_hidden_bench(bench, {}).value();
  const Recording& r = made.ideal.recordings[0];
  const Differences phi = series(r, Quantity::torsion);
  const auto& tau = r.channels.at(Quantity::transmitted_torque);
  double work = 0.0;
  double loss = 0.0;
  for (std::size_t k = 200; k < 400; ++k) {
    const double rate = phi.first(k);
    work += tau[k] * rate * phi.step;
    loss += bench.gear.damping(rate / bench.gear.modulation(phi.value[k])) * rate * phi.step;
  }
  EXPECT_NEAR(work / loss, 1.0, 1e-5);
  EXPECT_GT(loss, 0.0);
}

TEST(HiddenRefusals, NameWhatIsWrong) {
  const HiddenBench good = small_bench(Rig::specimen);
  const auto refused = [](const HiddenBench& bench, const std::vector<HiddenEffect>& effects,
                          const std::string& part) {
    const auto made = run_hidden_bench(bench, effects);
    ASSERT_FALSE(made) << part;
    EXPECT_EQ(made.error().code, ErrorCode::usage);
    EXPECT_NE(made.error().message().find(part), std::string::npos) << made.error().message();
    EXPECT_FALSE(made.error().remedy.empty());
  };
  refused(good, {{"backlassh", 0.1}}, "\"backlassh\" cannot be concealed");
  refused(good, {{"gravity_load", 0.1}}, "rig \"specimen\" cannot show effect \"gravity_load\"");
  refused(good, {{"backlash", 0.1}, {"backlash", 0.2}}, "twice");
  refused(good, {{"backlash", -0.1}}, "size_fraction = -0.1");
  HiddenBench bad = good;
  bad.design.clear();
  refused(bad, {}, "no excitation");
  bad = good;
  bad.design[1].amplitude = 0.0;
  refused(bad, {}, "amplitude (rad) = 0");
  bad = good;
  bad.nuisances.time_jitter = 0.5;
  refused(bad, {}, "time_jitter = 0.5");
}

}  // namespace
}  // namespace flexspline::data
