// The rate-independent fits on gears that remember.
#include <gtest/gtest.h>

#include "flexspline/core/simulate.hpp"
#include "flexspline/core/stop_operator.hpp"
#include "gears.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kStops[][2] = {{1.5, 0.07}, {2.2, 0.25}, {1.1, 0.55}};  // Nm/range, yield/range

/// A cubic spring beside three slip elements whose yields are on nobody's grid.
TorsionRecord slipping(double amplitude, double frequency) {
  auto record = measured({.f = smooth_gear().f, .g_inverse = [](double) { return 0.0; }},
                         {.amplitude = amplitude,
                          .frequency = frequency,
                          .noise = 1e-3,
                          .seed = static_cast<unsigned>(100.0 * amplitude)});
  for (const auto& [stiffness, yield] : kStops) {
    StopOperator stop(yield);
    double last = record.motion.front() / kAmplitude;
    for (std::size_t i = 0; i < record.motion.size(); ++i) {
      const double x = record.motion[i] / kAmplitude;
      record.effort[i] += stiffness * stop.advance(x - last);
      last = x;
    }
  }
  return record;
}

// Root mean square of measured minus simulated torque, in units of the largest measured.
double misfit(const ModelSpec& model, const TorsionRecord& record) {
  const auto torque = simulate_torque(model, motion_of(record));
  double sum = 0.0;
  double peak = 0.0;
  for (std::size_t i = 0; i < torque->size(); ++i) {
    sum += std::pow((*torque)[i] - record.effort[i], 2);
    peak = std::max(peak, std::abs(record.effort[i]));
  }
  return std::sqrt(sum / static_cast<double>(torque->size())) / peak;
}

TEST(PreslidingFit, PredictsLoopsOfOtherAmplitudesAndFrequencies) {
  const auto estimate =
      fitted("presliding_nnls", {slipping(1.0, 1.0), slipping(0.7, 1.0), slipping(0.4, 1.0)});
  ASSERT_TRUE(estimate) << estimate.error().message();
  for (double amplitude : {0.5, 0.85, 1.0}) {
    for (double frequency : {0.5, 2.0}) {
      EXPECT_LT(misfit(estimate->model, slipping(amplitude, frequency)), 0.01)
          << amplitude << " " << frequency;
    }
  }
}

// A viscous law reads the slip as speed: at another frequency it is wrong by far more.
TEST(PreslidingFit, BeatsAViscousLawWhereThereIsNoViscosity) {
  const auto slip = fitted("presliding_nnls", {slipping(1.0, 1.0)});
  const auto viscous = fitted("trajectory_ceres", {slipping(1.0, 1.0)},
                              {.numbers = {}, .words = {{"simulate", "torque"}}});
  ASSERT_TRUE(slip && viscous);
  for (double frequency : {0.5, 2.0}) {
    const auto other = slipping(1.0, frequency);
    EXPECT_LT(misfit(slip->model, other), 0.004);
    EXPECT_GT(misfit(viscous->model, other), 0.02);
  }
}

TEST(BoucWenFit, FindsItsOwnParameters) {
  const ModelSpec truth{
      .f = {.law = "odd_polynomial", .scale = kAmplitude, .knots = {}, .coefficients = {5.0, 8.0}},
      .g_inverse = {.law = "odd_polynomial", .scale = kSpeed, .knots = {}, .coefficients = {0.0}},
      .h = {.law = "bounded_modulation", .scale = kAmplitude, .knots = {}, .coefficients = {}},
      .effects = {
          {"bouc_wen", {{"height", 4.0}, {"slip_length", 0.3 * kAmplitude}, {"exponent", 1.4}}}}};
  std::vector<TorsionRecord> records;
  for (double amplitude : {1.0, 0.5}) {
    auto record = measured(smooth_gear(), {.amplitude = amplitude});
    record.effort = simulate_torque(truth, motion_of(record)).value();
    records.push_back(std::move(record));
  }
  const auto estimate = fitted("bouc_wen", records);
  ASSERT_TRUE(estimate) << estimate.error().message();
  ASSERT_EQ(estimate->model.effects.size(), 1U);
  const auto& found = estimate->model.effects.front().parameters;
  EXPECT_NEAR(found[0].second / 4.0, 1.0, 1e-3);
  EXPECT_NEAR(found[1].second / (0.3 * kAmplitude), 1.0, 1e-3);
  EXPECT_NEAR(found[2].second / 1.4, 1.0, 2e-3);
  EXPECT_LT(worst_error(
                estimate->model.f,
                [](double phi) {
                  const double x = phi / kAmplitude;
                  return 5.0 * x + 8.0 * x * x * x;
                },
                kAmplitude),
            1e-3);
}

}  // namespace
}  // namespace flexspline::estimators
