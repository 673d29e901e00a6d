// Duals against closed forms; constants beside numbers with directions.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "flexspline/core/dual.hpp"

namespace flexspline {
namespace {

struct Function {
  const char* name;
  std::function<Dual(const Dual&)> of;
  double value;
  double derivative;
};

TEST(Dual, FunctionsHaveTheirDerivatives) {
  const double x = 0.7;
  const double c = std::cosh(x);
  const Function functions[] = {
      {"-x", [](const Dual& a) { return -a; }, -x, -1.0},
      {"exp", [](const Dual& a) { return exp(a); }, std::exp(x), std::exp(x)},
      {"log", [](const Dual& a) { return log(a); }, std::log(x), 1.0 / x},
      {"sqrt", [](const Dual& a) { return sqrt(a); }, std::sqrt(x), 0.5 / std::sqrt(x)},
      {"sin", [](const Dual& a) { return sin(a); }, std::sin(x), std::cos(x)},
      {"cos", [](const Dual& a) { return cos(a); }, std::cos(x), -std::sin(x)},
      {"tanh", [](const Dual& a) { return tanh(a); }, std::tanh(x), 1.0 / (c * c)},
      {"atan", [](const Dual& a) { return atan(a); }, std::atan(x), 1.0 / (1.0 + x * x)},
      {"x^2.5", [](const Dual& a) { return pow(a, 2.5); }, std::pow(x, 2.5),
       2.5 * std::pow(x, 1.5)},
      {"x^x", [](const Dual& a) { return pow(a, a); }, std::pow(x, x),
       std::pow(x, x) * (1.0 + std::log(x))}};
  for (const Function& f : functions) {
    const Dual y = f.of(Dual(x, 2, 1));
    EXPECT_NEAR(y.value(), f.value, 1e-15) << f.name;
    EXPECT_EQ(y.slope(0), 0.0) << f.name;
    EXPECT_NEAR(y.slope(1), f.derivative, 2e-15) << f.name;
  }
}

TEST(Dual, OperationsHaveBothDerivatives) {
  const Dual a(3.0, 2, 0);
  const Dual b(-0.5, 2, 1);
  const struct {
    Dual y;
    double value, by_a, by_b;
  } expected[] = {{a + b, 2.5, 1.0, 1.0},
                  {a - b, 3.5, 1.0, -1.0},
                  {a * b, -1.5, -0.5, 3.0},
                  {a / b, -6.0, -2.0, -12.0}};
  for (const auto& one : expected) {
    EXPECT_EQ(one.y.value(), one.value);
    EXPECT_EQ(one.y.slope(0), one.by_a);
    EXPECT_EQ(one.y.slope(1), one.by_b);
  }
}

// The sum of two products of which one is of constants: the case that lost its gradient with
// expressions that are evaluated later.
TEST(Dual, ConstantsMixOnEitherSide) {
  const Dual x(3.0, kMostDirections, 5);
  const Dual width(4.0);
  for (const Dual& root : {sqrt(x * x + width * width), sqrt(width * width + x * x)}) {
    EXPECT_EQ(root.value(), 5.0);
    EXPECT_EQ(root.directions(), kMostDirections);
    EXPECT_DOUBLE_EQ(root.slope(5), 0.6);
    EXPECT_EQ(root.slope(4), 0.0);
  }
  EXPECT_EQ((width * width + 2.0).directions(), 0);
  EXPECT_EQ((width * width).slope(7), 0.0);
}

TEST(Dual, TailsOfTheHyperbolicTangentKeepTheirDigits) {
  const Dual y = tanh(Dual(40.0, 1, 0));
  EXPECT_DOUBLE_EQ(y.slope(0), 4.0 * std::exp(-80.0));
}

TEST(Dual, CompoundAssignmentReadsItsOwnValueOnce) {
  Dual x(3.0, 1, 0);
  x *= x;
  EXPECT_EQ(x.slope(0), 6.0);
  x -= x;
  EXPECT_EQ(x.slope(0), 0.0);
}

TEST(DualDeathTest, RefusesTooManyAndUnequalDirections) {
  const volatile int many = kMostDirections + 1;
  EXPECT_DEATH(Dual(1.0, many), "at most 32 directions");
  EXPECT_DEATH(Dual(1.0, 2, 0) + Dual(1.0, 3, 0), "along the same directions");
}

}  // namespace
}  // namespace flexspline
