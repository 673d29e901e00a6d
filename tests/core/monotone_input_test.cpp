// Measured inputs: shape, order, and what their noise does to a state.
#include "flexspline/core/monotone_input.hpp"

#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ode_examples.hpp"

namespace flexspline {
namespace {

TEST(MonotoneInput, NeverLeavesTheRangeOfNeighbouringSamples) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const auto time = instants(40.0, 40);
  std::vector<double> value(time.size());
  for (double& v : value) v = normal(random);
  const auto made = MonotoneInput::through(time, value);
  ASSERT_TRUE(made);
  for (std::size_t i = 0; i + 1 < time.size(); ++i) {
    const double rise = value[i + 1] - value[i];
    double before = value[i];
    for (int k = 0; k <= 20; ++k) {
      const double now = made->value(time[i] + k / 20.0);
      EXPECT_GE((now - before) * rise, -1e-12);
      before = now;
    }
    EXPECT_NEAR(before, value[i + 1], 1e-12);
  }
}

TEST(MonotoneInput, HasTheSlopeOfItsValue) {
  const auto time = instants(3.0, 30);
  std::vector<double> value;
  for (const double t : time) value.push_back(std::exp(0.5 * t) + 0.1 * std::sin(9.0 * t));
  const auto made = MonotoneInput::through(time, value);
  ASSERT_TRUE(made);
  for (double t = 0.03; t < 2.97; t += 0.0371) {
    EXPECT_NEAR(made->slope(t), (made->value(t + 1e-6) - made->value(t - 1e-6)) / 2e-6, 1e-5);
  }
  EXPECT_EQ(made->value(-1.0), value.front());
  EXPECT_EQ(made->value(5.0), value.back());
  EXPECT_EQ(made->slope(5.0), 0.0);
}

TEST(MonotoneInput, ConvergesOnAMonotoneSignal) {
  const auto error = [](int count) {
    const auto time = instants(2.0, count);
    std::vector<double> value;
    for (const double t : time) value.push_back(std::exp(t));
    const auto made = MonotoneInput::through(time, value);
    double most = 0.0;
    for (double t = 0.5; t < 1.5; t += 0.00123) {
      most = std::max(most, std::abs(made->value(t) - std::exp(t)));
    }
    return most;
  };
  EXPECT_GT(std::log2(error(40) / error(80)), 2.7);
  EXPECT_GT(std::log2(error(80) / error(160)), 2.7);
}

TEST(MonotoneInput, RefusesWhatIsNoSignal) {
  const std::vector<double> few = {0.0, 1.0, 2.0};
  EXPECT_FALSE(MonotoneInput::through(few, few));
  const std::vector<double> time = {0.0, 1.0, 1.0, 2.0};
  const auto made = MonotoneInput::through(time, time);
  ASSERT_FALSE(made);
  EXPECT_THAT(made.error().message(), testing::HasSubstr("sample 3 of an input, at 1 s"));
  const std::vector<double> gap = {0.0, 1.0, NAN, 2.0};
  EXPECT_FALSE(MonotoneInput::through(instants(3.0, 3), gap));
}

constexpr SystemSettings kSettings{
    .stepping = Stepping::bdf, .relative_tolerance = 1e-9, .absolute_tolerance = {}};

TEST(InputSensitivity, OfALagIsItsClosedForm) {
  const double p[] = {1.7, 0.0};
  const double start[] = {0.4};
  const auto times = instants(3.0, 15);
  const auto made = input_sensitivity(SystemOf<Lag>(), p, 1, {.deviation = 0.3, .interval = 0.01},
                                      times, start, kSettings);
  ASSERT_TRUE(made) << made.error().message();
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double closed = 0.09 * 0.01 / (2.0 * 1.7) * (1.0 - std::exp(-2.0 * 1.7 * times[i]));
    EXPECT_NEAR((*made)[i], closed, 1e-6 * 0.09 * 0.01);
  }
}

/// y'' = -w^2 y - 2 d y' + error: p = (w, d, error).
struct DampedOscillator {
  std::size_t states() const { return 2; }
  std::size_t parameters() const { return 3; }
  template <class S>
  void rate(double, std::span<const S> y, std::span<const S> p, std::span<S> out) const {
    out[0] = y[1];
    out[1] = S(p[2] - S(S(S(p[0] * p[0]) * y[0]) + S(S(2.0 * p[1]) * y[1])));
  }
};

TEST(InputSensitivity, OfADampedOscillatorEndsAtItsStationaryVariance) {
  const double p[] = {3.0, 0.4, 0.0};
  const double start[] = {0.0, 0.0};
  const auto made =
      input_sensitivity(SystemOf<DampedOscillator>(), p, 2, {.deviation = 2.0, .interval = 0.005},
                        instants(40.0, 1), start, kSettings);
  ASSERT_TRUE(made) << made.error().message();
  const double intensity = 4.0 * 0.005;
  EXPECT_NEAR((*made)[3] / (intensity / (4.0 * 0.4)), 1.0, 1e-5);
  EXPECT_NEAR((*made)[2] / (intensity / (4.0 * 0.4 * 9.0)), 1.0, 1e-5);
}

/// y' = -a y + (measured input + error).
struct MeasuredLag {
  MonotoneInput input;
  std::size_t states() const { return 1; }
  std::size_t parameters() const { return 2; }
  template <class S>
  void rate(double t, std::span<const S> y, std::span<const S> p, std::span<S> out) const {
    out[0] = S(S(p[1] + input.value(t)) - S(p[0] * y[0]));
  }
};

TEST(InputSensitivity, IsTheScatterOverManyNoisyInputs) {
  constexpr int kRuns = 400;
  const auto time = instants(4.0, 200);
  const double p[] = {0.8, 0.0};
  const double start[] = {0.0};
  const InputNoise noise{.deviation = 0.05, .interval = 0.02};
  const double ends[] = {0.0, 4.0};
  double sum = 0.0, squares = 0.0;
  for (unsigned run = 0; run < kRuns; ++run) {
    std::mt19937_64 random(run);
    std::normal_distribution<double> normal(0.0, noise.deviation);
    std::vector<double> value;
    for (const double t : time) value.push_back(std::exp(0.3 * t) + normal(random));
    const auto input = MonotoneInput::through(time, value);
    SystemSettings how = kSettings;
    how.relative_tolerance = 1e-6;
    const auto made = integrate_system(SystemOf(MeasuredLag{*input}), p, ends, start, how);
    ASSERT_TRUE(made);
    sum += made->state.back();
    squares += made->state.back() * made->state.back();
  }
  const double variance = (squares - sum * sum / kRuns) / (kRuns - 1);
  const auto stated = input_sensitivity(SystemOf<Lag>(), p, 1, noise, ends, start, kSettings);
  ASSERT_TRUE(stated);
  EXPECT_NEAR(variance / stated->back(), 1.0, 0.21) << "three deviations of a variance of 400 runs";
}

}  // namespace
}  // namespace flexspline
