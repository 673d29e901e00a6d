// How the bench moves and measures: run-up, harmonics, lag, encoder, noise, refusals.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/counter_noise.hpp"
#include "bench_fixture.hpp"

namespace flexspline::data {
namespace {

constexpr double kTau = 2.0 * std::numbers::pi;

const std::vector<double>& angle_of(const BenchRecording& made) {
  return made.measured.channels.at(Quantity::motor_angle);
}
const std::vector<double>& torque_of(const BenchRecording& made) {
  return made.measured.channels.at(Quantity::transmitted_torque);
}

TEST(BenchMotion, StartsAtRestAndStaysInsideTheSteadyRange) {
  for (const TruthRow& row : truths()) {
    const auto made = record(std::string(row.id), kPaperAmplitude, kPaperFrequency);
    EXPECT_EQ(made.motion.position[0], 0.0) << row.id;
    EXPECT_EQ(made.motion.velocity[0], 0.0) << row.id;
    EXPECT_EQ(made.motion.acceleration[0], 0.0) << row.id;
    EXPECT_EQ(made.torque[0], 0.0) << row.id;
    const auto in_cycle = [&](const std::vector<double>& v, int cycle) {
      const auto from = v.begin() + 500 * cycle;
      const auto [low, high] = std::minmax_element(from, from + 500);
      return std::max(-*low, *high);
    };
    const double slack = 1.0 + 1e-12;
    EXPECT_LE(in_cycle(made.motion.position, 0), slack * in_cycle(made.motion.position, 2));
    EXPECT_LE(in_cycle(made.motion.velocity, 0), slack * in_cycle(made.motion.velocity, 2));
  }
}

TEST(BenchMotion, DerivativesAreThoseOfThePosition) {
  const BenchTruth truth = find_truth("all").value()->make();
  const auto made = make_recording(truth, {kPaperAmplitude, 0.005, 2, 4000}, {}, 1, "d").value();
  const Motion& m = made.motion;
  const double step = m.time[1];
  const double rate = kTau * 0.005;
  for (std::size_t k = 1; k + 1 < m.time.size(); k += 7) {
    const double slope = (m.position[k + 1] - m.position[k - 1]) / (2.0 * step);
    const double bend = (m.velocity[k + 1] - m.velocity[k - 1]) / (2.0 * step);
    EXPECT_NEAR(m.velocity[k], slope, 2e-4 * kPaperAmplitude * rate) << k;
    EXPECT_NEAR(m.acceleration[k], bend, 2e-4 * kPaperAmplitude * rate * rate) << k;
  }
}

TEST(BenchMotion, SteadyCyclesHaveTheSameBits) {
  const auto made = record("all", kPaperAmplitude, 0.0085);
  for (std::size_t k = 500; k < 1000; ++k) {
    ASSERT_EQ(made.motion.position[k], made.motion.position[k + 1500]);
    ASSERT_EQ(made.motion.velocity[k], made.motion.velocity[k + 1500]);
    ASSERT_EQ(made.torque[k + 500], made.torque[k + 1500]);
  }
}

/// Amplitude of a harmonic of the position over the third cycle, share of kPaperAmplitude.
double harmonic(const BenchRecording& made, int order) {
  double c = 0.0;
  double s = 0.0;
  for (std::size_t k = 1000; k < 1500; ++k) {
    const double angle = kTau * order * static_cast<double>(k) / 500.0;
    c += made.motion.position[k] * std::cos(angle) / 250.0;
    s += made.motion.position[k] * std::sin(angle) / 250.0;
  }
  return std::hypot(c, s) / kPaperAmplitude;
}

TEST(BenchMotion, HarmonicsHaveTheirShares) {
  const auto made = record("harmonics", kPaperAmplitude, kPaperFrequency);
  EXPECT_NEAR(harmonic(made, 1), 1.0, 1e-12);
  EXPECT_NEAR(harmonic(made, 2), 0.02, 1e-12);
  EXPECT_NEAR(harmonic(made, 3), 0.03, 1e-12);
  EXPECT_NEAR(harmonic(made, 4), 0.0, 1e-12);
  // In the cosine form that defines the phases, the crest of the fundamental is the origin.
  const double crest = 1.0 + 0.03 * std::cos(0.7) + 0.02 * std::cos(0.4);
  EXPECT_NEAR(made.motion.position[1125] / kPaperAmplitude, crest, 1e-12);
}

TEST(BenchMotion, SamplesAreUniformAndNominalValuesAreStated) {
  const auto made = record("unity", 0.7 * kPaperAmplitude, 0.01);
  ASSERT_EQ(made.measured.time.size(), 2500U);
  EXPECT_EQ(made.measured.time.front(), 0.0);
  EXPECT_NEAR(made.measured.time.back(), 2499.0 / 500.0 / 0.01, 1e-9);
  EXPECT_EQ(made.measured.time, made.motion.time);
  EXPECT_EQ(made.measured.amplitude, 0.7 * kPaperAmplitude);
  EXPECT_EQ(made.measured.frequency_hz, 0.01);
  EXPECT_EQ(made.measured.excitation, "sine");
  EXPECT_EQ(made.measured.id, "sine");
}

TEST(BenchLag, IsAShiftInTime) {
  for (const char* id : {"unity", "rate_independent"}) {
    BenchTruth truth = find_truth(id).value()->make();
    const BenchExcitation excitation{kPaperAmplitude, 0.005, 3, 500};
    const auto prompt = make_recording(truth, excitation, {}, 1, "p").value();
    truth.sensor_lag_s = 7.0 * prompt.motion.time[1];
    const auto late = make_recording(truth, excitation, {}, 1, "l").value();
    EXPECT_EQ(late.motion.position, prompt.motion.position);
    for (std::size_t k = 0; k < late.torque.size(); ++k) {
      ASSERT_NEAR(late.torque[k], k < 7 ? 0.0 : prompt.torque[k - 7], 1e-11) << id << " " << k;
    }
  }
  EXPECT_NEAR(find_truth("sensor_lag").value()->make().sensor_lag_s * kPaperFrequency * 360.0, 1.72,
              0.005);
}

TEST(BenchEncoder, CountsAtTheMotorShaft) {
  const double step = kTau / 4096.0;
  const auto made = record("unity", kPaperAmplitude, 0.005, {.encoder_step = step});
  for (std::size_t k = 0; k < 2500; ++k) {
    const double count = angle_of(made)[k] / step;
    ASSERT_NEAR(count, std::round(count), 1e-9);
    ASSERT_LE(std::abs(angle_of(made)[k] - 50.0 * made.motion.position[k]), 0.5 * step * 1.000001);
  }
  const auto ideal = record("unity", kPaperAmplitude, 0.005);
  EXPECT_NEAR(angle_of(ideal)[1125], 10.0 * kRadPerDeg, 1e-12);
  EXPECT_EQ(torque_of(ideal), ideal.torque);
}

/// Root mean square of the torque's noise and its correlation between neighbours.
std::pair<double, double> torque_noise(const BenchRecording& made) {
  double square = 0.0;
  double product = 0.0;
  double last = 0.0;
  for (std::size_t k = 0; k < made.torque.size(); ++k) {
    const double noise = torque_of(made)[k] - made.torque[k];
    square += noise * noise;
    product += noise * last;
    last = noise;
  }
  return {std::sqrt(square / static_cast<double>(made.torque.size())), product / square};
}

BenchRecording long_recording(const BenchSensors& sensors) {
  const BenchTruth truth = find_truth("unity").value()->make();
  return make_recording(truth, {kPaperAmplitude, 0.005, 100, 2000}, sensors, 5, "long").value();
}

TEST(BenchNoise, WhiteHasItsSizeAndNoMemory) {
  const auto made = long_recording({.angle_noise = 0.005, .torque_noise_white = 0.005});
  const auto [rms, neighbour] = torque_noise(made);
  const double n = 200000.0;
  EXPECT_NEAR(rms / (0.005 * 16.54), 1.0, 5.0 / std::sqrt(2.0 * n));
  EXPECT_NEAR(neighbour, 0.0, 5.0 / std::sqrt(n));
  double square = 0.0;
  for (std::size_t k = 0; k < made.motion.time.size(); ++k) {
    square += std::pow(angle_of(made)[k] / 50.0 - made.motion.position[k], 2);
  }
  EXPECT_NEAR(std::sqrt(square / n) / (0.005 * kPaperAmplitude), 1.0, 5.0 / std::sqrt(2.0 * n));
}

TEST(BenchNoise, ColouredHasItsSizeAndItsMemory) {
  const auto [rms, neighbour] =
      torque_noise(long_recording({.torque_noise_coloured = 0.01, .torque_noise_samples = 20}));
  // A first-order process of correlation r has n (1 - r^2)/(1 + r^2) independent squares.
  const double r = std::exp(-1.0 / 20.0);
  const double independent = 200000.0 * (1.0 - r * r) / (1.0 + r * r);
  EXPECT_NEAR(rms / (0.01 * 16.54), 1.0, 5.0 / std::sqrt(2.0 * independent));
  EXPECT_NEAR(neighbour, r, 5.0 * std::sqrt((1.0 - r * r) / 200000.0));
}

TEST(BenchNoise, IsNormal) {
  const CounterNoise noise(3, "x", 0);
  const int n = 100000;
  double third = 0.0;
  double fourth = 0.0;
  int beyond_two = 0;
  for (std::uint64_t k = 0; k < n; ++k) {
    const double z = noise.normal(k);
    third += z * z * z / n;
    fourth += z * z * z * z / n;
    beyond_two += std::abs(z) > 2.0;
  }
  EXPECT_NEAR(third, 0.0, 5.0 * std::sqrt(15.0 / n));
  EXPECT_NEAR(fourth, 3.0, 5.0 * std::sqrt(96.0 / n));
  EXPECT_NEAR(beyond_two / static_cast<double>(n), 0.0455, 5.0 * std::sqrt(0.0455 / n));
}

TEST(BenchNoise, DependsOnSeedAndIdAlone) {
  const BenchSensors noisy{1e-5, 0.005, 0.005, 0.005, 20};
  const auto first = record("h_even", kPaperAmplitude, 0.005, noisy, 7, "a");
  const auto other_id = record("h_even", kPaperAmplitude, 0.005, noisy, 7, "b");
  const auto other_seed = record("h_even", kPaperAmplitude, 0.005, noisy, 8, "a");
  const auto again = record("h_even", kPaperAmplitude, 0.005, noisy, 7, "a");
  EXPECT_EQ(torque_of(first), torque_of(again));
  EXPECT_EQ(angle_of(first), angle_of(again));
  EXPECT_EQ(first.torque, other_id.torque);
  for (const auto* other : {&other_id, &other_seed}) {
    double product = 0.0;
    double square = 0.0;
    for (std::size_t k = 0; k < 2500; k += 50) {  // beyond the memory of the coloured part
      const double noise = torque_of(first)[k] - first.torque[k];
      product += noise * (torque_of(*other)[k] - other->torque[k]);
      square += noise * noise;
    }
    EXPECT_LT(std::abs(product / square), 5.0 / std::sqrt(50.0));
    EXPECT_NE(torque_of(first), torque_of(*other));
  }
}

TEST(BenchNoise, CountersNeedNoOrder) {
  const CounterNoise noise(9, "a", 2);
  std::vector<double> forwards(64);
  std::vector<double> backwards(64);
  for (std::size_t k = 0; k < 64; ++k) forwards[k] = noise.normal(k);
  for (std::size_t k = 64; k-- > 0;) backwards[k] = CounterNoise(9, "a", 2).normal(k);
  EXPECT_EQ(forwards, backwards);
  EXPECT_NE(noise.normal(0), CounterNoise(9, "a", 1).normal(0));
}

TEST(BenchRefusals, NameTheSettingAndItsValue) {
  const BenchTruth truth = find_truth("unity").value()->make();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [&](const BenchExcitation& e, const BenchSensors& s,
                           const std::string& name) {
    const auto made = make_recording(truth, e, s, 1, "case-1");
    ASSERT_FALSE(made) << name;
    EXPECT_EQ(made.error().code, ErrorCode::usage);
    EXPECT_NE(made.error().problem.find(name), std::string::npos) << made.error().problem;
    EXPECT_NE(made.error().message().find("case-1"), std::string::npos);
    EXPECT_FALSE(made.error().remedy.empty());
  };
  refused({0.0, 0.005, 5, 500}, {}, "amplitude (rad) = 0");
  refused({0.003, nan, 5, 500}, {}, "frequency_hz = nan");
  refused({0.003, 0.005, 0, 500}, {}, "cycles = 0");
  refused({0.003, 0.005, 5, 3}, {}, "samples_per_cycle = 3");
  refused({0.003, 0.005, 5, 500}, {.torque_noise_white = -1.0}, "torque_noise_white = -1");
  refused({0.003, 0.005, 5, 500}, {.torque_noise_samples = 0.0}, "torque_noise_samples = 0");
}

TEST(BenchRefusals, ATorqueThatIsNotFiniteIsNotRecorded) {
  const BenchTruth truth = find_truth("table_i").value()->make();
  const auto made = make_recording(truth, {1e60, 0.005, 5, 500}, {}, 1, "far");
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::numerics);
  EXPECT_NE(made.error().problem.find("far"), std::string::npos);
}

TEST(BenchSet, IsThePapersBench) {
  const RecordingSet set = paper_bench("paper", {record("unity", kPaperAmplitude, 0.005).measured});
  EXPECT_EQ(set.rig, Rig::locked);
  EXPECT_EQ(set.constants.at("gear_ratio"), 50.0);
  EXPECT_EQ(set.constants.at("motor_inertia_kgm2"), 0.726e-3);
  EXPECT_EQ(set.constants.at("rated_torque_nm"), 226.0);
  EXPECT_EQ(set.display.motion, "deg");
  EXPECT_EQ(set.recordings.size(), 1U);
}

}  // namespace
}  // namespace flexspline::data
