// The sign with which a motor's dry friction turns, where most of the friction is a cause's.
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "active_cause.hpp"
#include "diagnosis/frame/shared_baseline.hpp"
#include "diagnosis/model/motor_sign.hpp"
#include "stribeck_frame.hpp"

namespace flexspline::studies {
namespace {

Findings with_stribeck(const Frame& frame) {
  Findings findings = *fit_baseline(frame);
  const auto [row, form] = form_named(frame, "stribeck_friction");
  auto fit = extended(frame, findings, active(frame, *row, *form), 30);
  EXPECT_TRUE(fit) << (fit ? "" : fit.error().message());
  findings.fit = *std::move(fit);
  EXPECT_TRUE(refresh(frame, findings, 30));
  return findings;
}

// What the best mixture of dry_widths() is off by half way between two, where it turns.
constexpr double kBetweenWidths = 0.006;

/// What the motor's equation is fitted by: changes of the excess, the speed and the exponent, each
/// over itself, and the columns of the baseline that have a part.
Eigen::MatrixXd free_columns(const Frame& frame, const Findings& findings) {
  const auto c = shared_baseline(frame, Equation::motor, {});
  const Eigen::VectorXd& own = findings.fit.model.own[index_of(Equation::motor)];
  const Eigen::ArrayXd x = (frame.motor_speed / (kStribeckFalls * frame.speed_range)).abs();
  const Eigen::ArrayXd excess = kStribeckExcess * (-x.square()).exp() * stribeck_sign(frame);
  Eigen::MatrixXd columns(frame.rows(), 3 + (own.array() > 0.0).count());
  columns.col(0) = excess;
  columns.col(1) = 2.0 * x.square() * excess;
  columns.col(2) = -2.0 * x.square() * x.max(1e-12).log() * excess;
  Eigen::Index next = 3;
  for (Eigen::Index k = 0; k < own.size(); ++k) {
    if (own[k] > 0.0) columns.col(next++) = c->columns.col(k);
  }
  return columns;
}

TEST(MotorSign, IsThatOfAllFrictionAndNotOfWhatTheBaselineHasOfIt) {
  const Frame frame = stribeck_frame();
  const Findings findings = with_stribeck(frame);
  const double turning = 0.05 * static_cast<double>(frame.rows());  // rows where the sign turns
  const double height = kStribeckCoulomb + kStribeckExcess;         // of the friction there
  const Eigen::ArrayXd sign = motor_sign(frame, findings.fit.model);
  EXPECT_LT(std::sqrt((sign - stribeck_sign(frame)).square().mean()),
            4.0 * kStribeckNoise / std::sqrt(turning) / height);
  const std::vector<double>& shape = findings.fit.model.causes.front().shape;
  const Eigen::MatrixXd columns = free_columns(frame, findings);
  const Eigen::ArrayXd error =
      findings.fit.prediction[index_of(Equation::motor)] - stribeck_torque(frame);
  EXPECT_LT(error.matrix().norm(),
            2.0 * kStribeckNoise * std::sqrt(static_cast<double>(columns.cols())) +
                kBetweenWidths * height * std::sqrt(turning));
  // As well as wide signs of the baseline's tell them apart (Cramer and Rao).
  const Eigen::MatrixXd covariance = (columns.transpose() * columns).inverse();
  const Eigen::ArrayXd bound = 4.0 * kStribeckNoise * covariance.diagonal().array().sqrt();
  EXPECT_NEAR(findings.fit.model.coefficients.front()[0] / kStribeckExcess, 1.0, bound[0]);
  EXPECT_NEAR(shape[0] / (kStribeckFalls * frame.speed_range), 1.0, bound[1]);
  EXPECT_NEAR(shape[1] / 2.0, 1.0, bound[2]);
}

// What is exported has the laws of the model itself, and has to predict what the fit did.
TEST(MotorSign, OfAFittedModelIsTheOneItWasFittedWith) {
  const Frame frame = stribeck_frame();
  const Findings findings = with_stribeck(frame);
  const DriveModel& model = findings.fit.model;
  const std::size_t e = index_of(Equation::motor);
  const ModelFit own = evaluate(frame, model, reference_of(frame, model));
  EXPECT_LT((own.residual[e] - findings.fit.residual[e]).abs().maxCoeff(), 1e-12);
}

TEST(MotorSign, HasNoSharesWhereNoCauseTurnsWithIt) {
  const Frame frame = stribeck_frame();
  Findings findings = *fit_baseline(frame);
  const std::size_t e = index_of(Equation::motor);
  const auto shares = [&] {
    return fitted_sign(frame, findings.fit, findings.reference, findings.weight[e]);
  };
  EXPECT_EQ(shares().size(), 0);
  const auto [row, form] = form_named(frame, "motor_torque_offset");
  findings.fit = *extended(frame, findings, active(frame, *row, *form), 5);
  EXPECT_EQ(shares().size(), 0);
}

}  // namespace
}  // namespace flexspline::studies
