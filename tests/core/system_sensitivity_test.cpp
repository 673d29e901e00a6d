// Forward, adjoint and difference derivatives of the same trajectories.
#include <cmath>
#include <memory>
#include <ostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/core/ode_system.hpp"
#include "ode_examples.hpp"

namespace flexspline {
namespace {

SystemSettings tight(Stepping stepping = Stepping::bdf, double tolerance = 1e-11) {
  return {.stepping = stepping, .relative_tolerance = tolerance, .absolute_tolerance = {}};
}

double weighted(const SystemTrajectory& made, std::span<const double> weight) {
  double sum = 0.0;
  for (std::size_t k = 0; k < weight.size(); ++k) sum += weight[k] * made.state[k];
  return sum;
}

std::vector<double> weighted_sensitivity(const SystemTrajectory& made,
                                         std::span<const double> weight, std::size_t parameters) {
  std::vector<double> sum(parameters, 0.0);
  for (std::size_t k = 0; k < weight.size(); ++k) {
    for (std::size_t j = 0; j < parameters; ++j) {
      sum[j] += weight[k] * made.sensitivity[k * parameters + j];
    }
  }
  return sum;
}

// Central differences of fourth order.
std::vector<double> difference(const OdeSystem& system, std::vector<double> p,
                               std::span<const double> times, std::span<const double> initial,
                               std::span<const double> weight) {
  std::vector<double> gradient;
  for (double& value : p) {
    const double kept = value;
    const auto at = [&](double h) {
      value = kept + h;
      return weighted(*integrate_system(system, p, times, initial, tight(Stepping::bdf, 1e-12)),
                      weight);
    };
    const double h = 2e-3 * std::abs(kept);
    gradient.push_back((8.0 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12.0 * h));
    value = kept;
  }
  return gradient;
}

void expect_six_digits(std::span<const double> a, std::span<const double> b, const char* what) {
  double largest = 0.0;
  for (const double x : b) largest = std::max(largest, std::abs(x));
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t j = 0; j < a.size(); ++j) {
    EXPECT_NEAR(a[j], b[j], 1e-6 * (std::abs(b[j]) + 1e-2 * largest))
        << what << ", parameter " << j;
  }
}

struct Problem {
  const char* name;
  std::shared_ptr<OdeSystem> system;
  std::vector<double> p;
  std::vector<double> initial;
  std::vector<double> times;
};

void PrintTo(const Problem& problem, std::ostream* out) { *out << problem.name; }

Problem van_der_pol() {
  return {"van_der_pol",
          std::make_shared<SystemOf<VanDerPol>>(),
          {1.5, 1.1, 0.4},
          {0.5, -0.2},
          instants(6.0, 4)};
}

Problem chain() {
  Problem problem{"chain",
                  std::make_shared<SystemOf<Chain>>(Chain{40}),
                  {},
                  std::vector<double>(40, 0.1),
                  instants(12.0, 3)};
  for (int i = 0; i < 40; ++i) problem.p.push_back(4.0 + 0.1 * i);
  return problem;
}

std::vector<double> weights_of(const Problem& problem) {
  std::vector<double> weight(problem.times.size() * problem.initial.size());
  for (std::size_t k = 0; k < weight.size(); ++k) {
    weight[k] = std::cos(1.0 + 0.7 * static_cast<double>(k));
  }
  return weight;
}

class Sensitivities : public testing::TestWithParam<Problem> {};
INSTANTIATE_TEST_SUITE_P(Of, Sensitivities, testing::Values(van_der_pol(), chain()),
                         [](const auto& of) { return of.param.name; });

TEST_P(Sensitivities, AgreeForwardAdjointAndByDifferences) {
  const auto& [name, system, p, initial, times] = GetParam();
  const auto weight = weights_of(GetParam());
  const auto forward = integrate_with_sensitivities(*system, p, times, initial, {}, tight());
  const auto adjoint = adjoint_gradient(*system, p, times, initial, {}, weight, tight());
  ASSERT_TRUE(forward) << forward.error().message();
  ASSERT_TRUE(adjoint) << adjoint.error().message();
  const auto summed = weighted_sensitivity(*forward, weight, p.size());
  expect_six_digits(*adjoint, summed, "adjoint against forward");
  expect_six_digits(summed, difference(*system, p, times, initial, weight),
                    "forward against differences");
}

TEST_P(Sensitivities, AgreeByAdams) {
  const auto& [name, system, p, initial, times] = GetParam();
  const auto weight = weights_of(GetParam());
  const auto how = tight(Stepping::adams);
  const auto forward = integrate_with_sensitivities(*system, p, times, initial, {}, how);
  const auto adjoint = adjoint_gradient(*system, p, times, initial, {}, weight, how);
  ASSERT_TRUE(forward && adjoint);
  expect_six_digits(*adjoint, weighted_sensitivity(*forward, weight, p.size()), "Adams");
}

// The initial state as a parameter, and weights that end before the last instant.
TEST_P(Sensitivities, CarryTheInitialState) {
  const auto& [name, system, p, initial, times] = GetParam();
  std::vector<double> start(initial.size() * p.size());
  for (std::size_t k = 0; k < start.size(); ++k) start[k] = std::sin(static_cast<double>(k));
  auto weight = weights_of(GetParam());
  std::fill(weight.end() - static_cast<std::ptrdiff_t>(initial.size()), weight.end(), 0.0);
  const auto forward = integrate_with_sensitivities(*system, p, times, initial, start, tight());
  const auto adjoint = adjoint_gradient(*system, p, times, initial, start, weight, tight());
  ASSERT_TRUE(forward && adjoint);
  expect_six_digits(*adjoint, weighted_sensitivity(*forward, weight, p.size()), "initial state");
}

TEST(SystemSensitivity, OfAnOscillationIsItsClosedForm) {
  const double w[] = {2.0};
  const double start[] = {1.0, 0.0};
  const auto times = instants(10.0, 20);
  std::vector<double> errors;
  for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
    const auto made = integrate_with_sensitivities(SystemOf<Oscillator>(), w, times, start, {},
                                                   tight(Stepping::bdf, tolerance));
    ASSERT_TRUE(made);
    double error = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double t = times[i];
      error = std::max(error, std::abs(made->sensitivity[2 * i] + t * std::sin(2.0 * t)));
    }
    EXPECT_LT(error, 1e4 * tolerance);
    errors.push_back(error);
  }
  EXPECT_LT(errors[1], 0.05 * errors[0]);
  EXPECT_LT(errors[2], 0.05 * errors[1]);
}

TEST(SystemSensitivity, OfTheStiffLockedRotorAgreesWithTheAdjoint) {
  const double viscous[] = {0.5};
  const double start[] = {LockedRotor::position(0.0), LockedRotor::speed(0.0)};
  const auto times = instants(200.0, 4);
  SystemSettings how = tight(Stepping::bdf, 1e-10);
  how.absolute_tolerance = {2e-11, 6e-13};
  std::vector<double> weight(2 * times.size(), 0.0);
  weight[2 * 1] = 1.0;
  weight[2 * 3] = -0.4;
  const SystemOf<LockedRotor> system;
  const auto forward = integrate_with_sensitivities(system, viscous, times, start, {}, how);
  const auto adjoint = adjoint_gradient(system, viscous, times, start, {}, weight, how);
  ASSERT_TRUE(forward) << forward.error().message();
  ASSERT_TRUE(adjoint) << adjoint.error().message();
  expect_six_digits(*adjoint, weighted_sensitivity(*forward, weight, 1), "locked rotor");
}

TEST(SystemSensitivity, OfNothingWeighedIsZero) {
  const auto& [name, system, p, initial, times] = van_der_pol();
  const std::vector<double> none(times.size() * 2, 0.0);
  const auto gradient = adjoint_gradient(*system, p, times, initial, {}, none, tight());
  ASSERT_TRUE(gradient);
  EXPECT_THAT(*gradient, testing::Each(0.0));
}

TEST(SystemSensitivity, SaysWhereTheAdjointStopped) {
  SystemSettings how = tight();
  how.max_steps = 20;
  const auto problem = van_der_pol();
  const auto gradient = adjoint_gradient(*problem.system, problem.p, problem.times, problem.initial,
                                         {}, weights_of(problem), how);
  ASSERT_FALSE(gradient);
  EXPECT_THAT(gradient.error().message(), testing::HasSubstr("stopped at t = "));
}

}  // namespace
}  // namespace flexspline
