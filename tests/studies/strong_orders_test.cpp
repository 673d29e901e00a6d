// Which orders of a turn of the motor what is left shows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis/search/strong_orders.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

constexpr std::size_t kMotor = 2;

Findings left(const Frame& f, const Eigen::ArrayXd& residual) {
  Findings findings;
  findings.fit.residual[kMotor] = residual;
  findings.weight[kMotor] = Eigen::ArrayXd::Ones(f.rows());
  return findings;
}

TEST(StrongOrders, FindsWavesUnderNoise) {
  const Frame f = closed_form_frame();
  const Eigen::ArrayXd waves = 0.3 * (84.0 * f.motor_angle + 1.0).sin() +
                               0.2 * (360.0 * f.motor_angle).cos() + normal(f.rows(), 3);
  EXPECT_THAT(strong_orders(f, left(f, waves), Equation::motor, 37, 400, 2),
              testing::ElementsAre(84.0, 360.0));
}

TEST(StrongOrders, LooksWhereItIsAskedToAndWhereRowsCount) {
  const Frame f = closed_form_frame();
  Findings findings = left(f, (84.0 * f.motor_angle).sin());
  for (const double order : strong_orders(f, findings, Equation::motor, 90, 93, 9)) {
    EXPECT_GE(order, 90.0);
    EXPECT_LE(order, 93.0);
  }
  const Eigen::Index half = f.rows() / 2;
  findings.fit.residual[kMotor].tail(half) = 5.0 * (120.0 * f.motor_angle.tail(half)).sin();
  findings.weight[kMotor].tail(half).setZero();
  EXPECT_EQ(strong_orders(f, findings, Equation::motor, 37, 400, 1).front(), 84.0);
}

}  // namespace
}  // namespace flexspline::studies
