// Systems of equations with a closed form, and how their error follows the tolerance.
#include "flexspline/core/ode_system.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "claims/claims.hpp"
#include "ode_examples.hpp"

namespace flexspline {
namespace {

SystemSettings settings(Stepping stepping, double tolerance) {
  return {.stepping = stepping, .relative_tolerance = tolerance, .absolute_tolerance = {}};
}

// Slope of log(error) over log(x), by least squares.
double slope(const std::vector<double>& x, const std::vector<double>& error) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = std::log(x[i]), v = std::log(error[i]);
    sx += u, sy += v, sxx += u * u, sxy += u * v;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

class BothMethods : public testing::TestWithParam<Stepping> {};
INSTANTIATE_TEST_SUITE_P(Cvodes, BothMethods, testing::Values(Stepping::bdf, Stepping::adams));

TEST_P(BothMethods, ErrFromAnOscillationInProportionToTheTolerance) {
  const SystemOf<Oscillator> system;
  const double w[] = {2.0};
  const double start[] = {1.0, 0.0};
  const auto times = instants(20.0, 40);
  std::vector<double> tolerances, errors, of_a_step, energies, steps;
  for (double tolerance = 1e-4; tolerance > 1e-11; tolerance /= 10.0) {
    const auto made = integrate_system(system, w, times, start, settings(GetParam(), tolerance));
    ASSERT_TRUE(made) << made.error().message();
    double error = 0.0, energy = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double y = made->state[2 * i], v = made->state[2 * i + 1];
      error = std::max(error, std::abs(y - std::cos(2.0 * times[i])));
      energy = std::max(energy, std::abs(0.25 * v * v + y * y - 1.0));
    }
    tolerances.push_back(tolerance);
    errors.push_back(error);
    energies.push_back(energy);
    steps.push_back(static_cast<double>(made->steps));
    of_a_step.push_back(error / steps.back());
  }
  // The tolerance holds for each step, so the sum of the errors falls with one order less the more
  // steps there are: tolerance^(q / (q + 1)) for a method of order q, 5 for BDF and up to 12 for
  // Adams.
  std::printf("error a step ~ tolerance^%.2f, error ~ tolerance^%.2f ~ steps^%.1f\n",
              slope(tolerances, of_a_step), slope(tolerances, errors), slope(steps, errors));
  EXPECT_NEAR(slope(tolerances, of_a_step), 1.0, 0.1);
  EXPECT_THAT(slope(tolerances, errors), testing::AllOf(testing::Gt(0.75), testing::Lt(1.05)));
  EXPECT_NEAR(slope(tolerances, energies), slope(tolerances, errors), 0.1);
  EXPECT_LT(slope(steps, errors), -4.0) << "steps of high order";
  claims::expect("docs/simulation.md", GetParam() == Stepping::bdf ? "order-bdf" : "order-adams",
                 {{"of a step", slope(tolerances, of_a_step)},
                  {"of the trajectory", slope(tolerances, errors)},
                  {"over steps", -slope(steps, errors)}});
}

TEST(IntegrateSystem, GoesThroughTheStiffLockedRotorInAThousandSteps) {
  const SystemOf<LockedRotor> system;
  const double viscous[] = {0.5};
  const double start[] = {LockedRotor::position(0.0), LockedRotor::speed(0.0)};
  const auto times = instants(200.0, 200);
  SystemSettings how = settings(Stepping::bdf, 1e-6);
  how.absolute_tolerance = {2e-7, 6e-9};
  const auto made = integrate_system(system, viscous, times, start, how);
  ASSERT_TRUE(made) << made.error().message();
  EXPECT_LE(made->steps, 1000);
  claims::expect("docs/simulation.md", "stiff-steps",
                 {{"steps", static_cast<double>(made->steps)}});
  std::printf("stiff locked rotor: %ld steps for 200 s\n", static_cast<long>(made->steps));
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_NEAR(made->state[2 * i], LockedRotor::position(times[i]),
                2e-4 * LockedRotor::kAmplitude);
  }
  how.stepping = Stepping::adams;
  const auto explicit_one = integrate_system(system, viscous, instants(0.5, 1), start, how);
  ASSERT_TRUE(explicit_one) << explicit_one.error().message();
  EXPECT_GT(explicit_one->steps, made->steps) << "0.5 s by Adams against 200 s by BDF";
}

TEST(IntegrateSystem, SaysWhenAndWhereItStopped) {  // y = 1 / (1 - t)
  SystemSettings how = settings(Stepping::bdf, 1e-8);
  how.max_steps = 5000;
  const double start[] = {1.0};
  const auto made = integrate_system(SystemOf<Explosion>(), {}, instants(2.0, 10), start, how);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::numerics);
  EXPECT_THAT(made.error().message(), testing::HasSubstr("stopped at t = 0.99999"));
  EXPECT_THAT(made.error().message(), testing::HasSubstr(" s with state ("));
}

TEST(IntegrateSystem, CountsItsStepsOverTheWholeTime) {
  SystemSettings how = settings(Stepping::bdf, 1e-8);
  how.max_steps = 50;
  const double w[] = {2.0};
  const double start[] = {1.0, 0.0};
  const auto made = integrate_system(SystemOf<Oscillator>(), w, instants(20.0, 1000), start, how);
  ASSERT_FALSE(made);
  EXPECT_THAT(made.error().message(), testing::HasSubstr("TOO_MUCH_WORK"));
}

}  // namespace
}  // namespace flexspline
