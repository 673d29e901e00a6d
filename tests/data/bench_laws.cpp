// Every truth of the virtual bench against the closed forms it is defined by.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "bench/table_one.hpp"
#include "bench_fixture.hpp"

namespace flexspline::data {
namespace {

/// (2 pi/w) sum b_k (A w)^(2k) (2k-1)!!/(2k)!!, in J: the loss per cycle of an odd polynomial
/// damper.
double closed_form_loss(double amplitude_deg, double rate) {
  double sum = 0.0;
  double ratio = 1.0;
  for (int k = 1; k <= 5; ++k) {
    ratio *= (2.0 * k - 1.0) / (2.0 * k);
    const double b = kTableOneDamping[static_cast<std::size_t>(k - 1)];
    sum += b * std::pow(amplitude_deg * rate, 2 * k) * ratio;
  }
  return 2.0 * std::numbers::pi / rate * sum * kRadPerDeg;
}

TEST(BenchTableOne, LosesTheClosedFormEnergyPerCycle) {
  for (const double share : {0.4, 0.7, 1.0}) {
    for (const double frequency : {0.0025, 0.005}) {
      const auto made = record("table_i", share * kPaperAmplitude, frequency);
      const double expected = closed_form_loss(0.2 * share, 2.0 * std::numbers::pi * frequency);
      for (const int cycle : {1, 4}) {
        EXPECT_NEAR(loss_of_cycle(made, cycle) / expected, 1.0, 1e-9) << share << " " << frequency;
      }
    }
  }
}

TEST(BenchTableOne, HasThePapersNumbers) {
  const auto made = record("table_i", kPaperAmplitude, kPaperFrequency);
  EXPECT_NEAR(*std::max_element(made.torque.begin(), made.torque.end()), 16.54, 0.005);
  EXPECT_NEAR(table_one_damping(kPaperSpeed), 4.47, 0.005);
  EXPECT_NEAR(loss_of_cycle(made, 2), 0.0431, 0.00005);
  EXPECT_NEAR(loss_of_cycle(made, 2) / kRadPerDeg, 2.468, 0.0005);
}

TEST(BenchTableOne, RisesOnlyAsFarAsItIsKnownTo) {
  const auto slope = [](auto f, double x) { return f(x * (1 + 1e-6)) - f(x * (1 - 1e-6)); };
  EXPECT_GT(slope(table_one_stiffness, 0.2361 * kRadPerDeg), 0.0);
  EXPECT_LT(slope(table_one_stiffness, 0.2363 * kRadPerDeg), 0.0);
  EXPECT_GT(slope(table_one_damping, 1.130 * kPaperSpeed), 0.0);
  EXPECT_LT(slope(table_one_damping, 1.140 * kPaperSpeed), 0.0);
}

TEST(BenchSmoothBase, IsThePrototypesAtItsEdge) {
  const BenchTruth truth = find_truth("unity").value()->make();
  EXPECT_NEAR(truth.stiffness(kPaperAmplitude), 16.58, 1e-12);
  const double slope = 979.6 * 2.0 * std::numbers::pi * 0.005 * 0.2;
  EXPECT_NEAR(truth.damping(kPaperSpeed), slope * (0.067 + 0.933 / std::numbers::sqrt2), 1e-12);
  EXPECT_NEAR(truth.damping(-0.5 * kPaperSpeed), -truth.damping(0.5 * kPaperSpeed), 1e-15);
}

TEST(BenchSmoothBase, ModulationDividesTheSpeed) {
  const BenchTruth truth = find_truth("h_even_odd").value()->make();
  EXPECT_NEAR(truth.log_modulation(kPaperAmplitude), 0.45, 1e-12);
  EXPECT_NEAR(truth.log_modulation(-kPaperAmplitude), 0.15, 1e-12);
  const auto made = record("h_even_odd", kPaperAmplitude, kPaperFrequency);
  for (const std::size_t k : {std::size_t{600}, std::size_t{1111}}) {
    const double h = std::exp(truth.log_modulation(made.motion.position[k]));
    EXPECT_NEAR(
        made.torque[k],
        truth.stiffness(made.motion.position[k]) + truth.damping(made.motion.velocity[k] / h),
        1e-12);
  }
}

TEST(BenchSmoothBase, ImperfectionsAddWhatTheyAreSaidTo) {
  const auto plain = record("unity", kPaperAmplitude, kPaperFrequency);
  const auto heavy = record("inertia", kPaperAmplitude, kPaperFrequency);
  const auto skewed = record("f_asymmetric", kPaperAmplitude, kPaperFrequency);
  const auto uneven = record("g_asymmetric", kPaperAmplitude, kPaperFrequency);
  const std::size_t edge = 2 * 500 + 125;
  const std::size_t middle = 2 * 500;
  EXPECT_NEAR(heavy.torque[edge] - plain.torque[edge], -0.8, 1e-12);
  EXPECT_NEAR(skewed.torque[edge] - plain.torque[edge], 1.0, 1e-12);
  EXPECT_NEAR(uneven.torque[middle] / plain.torque[middle], 1.15, 1e-12);
  EXPECT_NEAR(uneven.torque[middle + 250] / plain.torque[middle + 250], 0.85, 1e-9);
}

/// The truth "all" written out in the units of the operating point: a share A of the amplitude, q
/// of the frequency, at the angle a of the fundamental in its cosine form, 0.03 q late.
double written_out(double A, double q, double a) {
  a -= 0.03 * q;
  const double x = A * (std::cos(a) + 0.03 * std::cos(3 * a + 0.7) + 0.02 * std::cos(2 * a + 0.4));
  const double w =
      -A * q * (std::sin(a) + 0.09 * std::sin(3 * a + 0.7) + 0.04 * std::sin(2 * a + 0.4));
  const double bend =
      -A * q * q * (std::cos(a) + 0.27 * std::cos(3 * a + 0.7) + 0.08 * std::cos(2 * a + 0.4));
  const double z = w * std::exp(-0.15 * x - 0.3 * x * x);
  const double slope = 979.6 * 0.2 * 2.0 * std::numbers::pi * 0.005;
  const double g = slope * z * (0.067 + 0.933 * std::abs(z) / std::sqrt(1.0 + z * z));
  return 4.81 * x + 11.77 * x * x * x + x * x + g * (z > 0.0 ? 1.15 : 0.85) + 0.8 * bend;
}

TEST(BenchTruths, AllAtOnceIsTheSumWrittenOut) {
  const auto made = record("all", 0.7 * kPaperAmplitude, 2.0 * kPaperFrequency);
  for (std::size_t k = 1000; k < 1500; ++k) {
    const double a = 2.0 * std::numbers::pi * (static_cast<double>(k) / 500.0 - 0.25);
    ASSERT_NEAR(made.torque[k], written_out(0.7, 2.0, a), 1e-10) << k;
  }
}

TEST(BenchTruths, AllOfThePublishedComparisonAreThere) {
  for (const char* id :
       {"table_i", "unity", "h_even", "h_even_odd", "g_asymmetric", "f_asymmetric", "harmonics",
        "sensor_lag", "inertia", "all", "rate_independent", "rate_independent_viscous"}) {
    EXPECT_TRUE(find_truth(id)) << id;
  }
}

TEST(BenchTruths, EveryOneRunsIsPassiveAndHasModulationOneAtZero) {
  for (const TruthRow& row : truths()) {
    EXPECT_FALSE(row.summary.empty() || row.source.empty()) << row.id;
    EXPECT_EQ(row.make().log_modulation(0.0), 0.0) << row.id;
    const auto made = record(std::string(row.id), kPaperAmplitude, kPaperFrequency);
    EXPECT_GT(loss_of_cycle(made, 2), 0.02) << row.id;
  }
}

TEST(BenchTruths, AnUnknownOneIsRefusedWithTheList) {
  const auto found = find_truth("h_evn");
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::usage);
  EXPECT_NE(found.error().problem.find("h_evn"), std::string::npos);
  EXPECT_NE(found.error().remedy.find("h_even_odd"), std::string::npos);
}

}  // namespace
}  // namespace flexspline::data
