// The sign with which a motor's dry friction turns, where most of the friction is a cause's.
#include <cmath>

#include <gtest/gtest.h>

#include "active_cause.hpp"
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

TEST(MotorSign, IsThatOfAllFrictionAndNotOfWhatTheBaselineHasOfIt) {
  const Frame frame = stribeck_frame();
  const Findings findings = with_stribeck(frame);
  const double deviations = kStribeckNoise / std::sqrt(0.05 * static_cast<double>(frame.rows()));
  const Eigen::ArrayXd sign = motor_sign(frame, findings.fit.model);
  // Where it turns, a twentieth of the rows; over the friction's height there.
  EXPECT_LT(std::sqrt((sign - stribeck_sign(frame)).square().mean()),
            4.0 * deviations / (kStribeckCoulomb + kStribeckExcess));
  const std::vector<double>& shape = findings.fit.model.causes.front().shape;
  // Four deviations of three parameters that share a peak, each known about five times worse for
  // it: the peak is over 0.15 of the rows.
  const double bound = 4.0 * 5.0 * kStribeckNoise / kStribeckExcess /
                       std::sqrt(kStribeckFalls * static_cast<double>(frame.rows()));
  EXPECT_NEAR(shape[0] / (kStribeckFalls * frame.speed_range), 1.0, bound);
  EXPECT_NEAR(shape[1] / 2.0, 1.0, bound);
  EXPECT_NEAR(findings.fit.model.coefficients.front()[0] / kStribeckExcess, 1.0, bound);
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
