// Trajectories and sensitivities of equations that have a closed form.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/core/forward_sensitivity.hpp"

namespace flexspline {
namespace {

/// y' = b - a y; parameters a, b and the initial value.
class Relaxation final : public ScalarOde {
 public:
  Relaxation(double a, double b) : a_(a), b_(b) {}
  std::size_t parameters() const override { return 3; }
  double rate(double, double y) const override { return b_ - a_ * y; }
  double jacobian(double, double) const override { return -a_; }
  double parameter_derivative(double, double y, std::span<double> out) const override {
    out[0] = -y;
    out[1] = 1.0;
    out[2] = 0.0;
    return -a_;
  }

 private:
  double a_, b_;
};

/// y' = r y (1 - y), parameter r.
class Logistic final : public ScalarOde {
 public:
  explicit Logistic(double r) : r_(r) {}
  std::size_t parameters() const override { return 1; }
  double rate(double, double y) const override { return r_ * y * (1.0 - y); }
  double jacobian(double, double y) const override { return r_ * (1.0 - 2.0 * y); }
  double parameter_derivative(double t, double y, std::span<double> out) const override {
    out[0] = y * (1.0 - y);
    return jacobian(t, y);
  }

 private:
  double r_;
};

std::vector<double> instants(double end, int count) {
  std::vector<double> t;
  for (int i = 0; i <= count; ++i) t.push_back(end * i / count);
  return t;
}

constexpr IntegratorSettings kTight{.relative_tolerance = 1e-10, .absolute_tolerance = 1e-10};

TEST(ForwardSensitivity, OfALinearEquationIsItsClosedForm) {
  for (double a : {0.3, 2.0, 400.0}) {  // the last is stiff
    constexpr double kB = 1.7;
    constexpr double kStart = 0.4;
    const auto times = instants(5.0, 50);
    const double initial[] = {0.0, 0.0, 1.0};
    const auto made = integrate(Relaxation(a, kB), times, kStart, initial, kTight);
    ASSERT_TRUE(made);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double t = times[i];
      const double e = std::exp(-a * t);
      const double rest = kB / a;
      EXPECT_NEAR(made->state[i], rest + (kStart - rest) * e, 1e-7);
      EXPECT_NEAR(made->sensitivity[3 * i], -rest / a * (1.0 - e) - (kStart - rest) * t * e, 1e-7)
          << "a, t = " << t;
      EXPECT_NEAR(made->sensitivity[3 * i + 1], (1.0 - e) / a, 1e-7) << "b, t = " << t;
      EXPECT_NEAR(made->sensitivity[3 * i + 2], e, 1e-7) << "start, t = " << t;
    }
  }
}

TEST(ForwardSensitivity, OfANonlinearEquationIsItsClosedForm) {
  constexpr double kRate = 1.3;
  const auto times = instants(6.0, 30);
  const double initial[] = {0.0};
  const auto made = integrate(Logistic(kRate), times, 0.1, initial, kTight);
  ASSERT_TRUE(made);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double e = 9.0 * std::exp(-kRate * times[i]);
    EXPECT_NEAR(made->state[i], 1.0 / (1.0 + e), 1e-8);
    EXPECT_NEAR(made->sensitivity[i], times[i] * e / ((1.0 + e) * (1.0 + e)), 1e-7);
  }
}

TEST(ForwardSensitivity, IsTheCentralDifferenceOfTheState) {
  const auto times = instants(4.0, 20);
  const double initial[] = {0.0};
  const auto made = integrate(Logistic(0.9), times, 0.2, initial, kTight);
  const auto up = integrate(Logistic(0.9 + 1e-3), times, 0.2, initial, kTight);
  const auto down = integrate(Logistic(0.9 - 1e-3), times, 0.2, initial, kTight);
  ASSERT_TRUE(made && up && down);
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_NEAR(made->sensitivity[i], (up->state[i] - down->state[i]) / 2e-3, 1e-6);
  }
}

/// y' = y^2 leaves every bound at t = 1/y(0).
class Explosion final : public ScalarOde {
 public:
  std::size_t parameters() const override { return 0; }
  double rate(double, double y) const override { return y * y; }
  double jacobian(double, double y) const override { return 2.0 * y; }
  double parameter_derivative(double t, double y, std::span<double>) const override {
    return jacobian(t, y);
  }
};

TEST(Integrate, SaysWhereAStateLeftEveryBound) {
  const auto made = integrate(Explosion(), instants(2.0, 10), 1.0, {}, {1e-8, 1e-8, 5000});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::numerics);
  EXPECT_THAT(made.error().message(), testing::HasSubstr("stopped at t = "));
}

}  // namespace
}  // namespace flexspline
