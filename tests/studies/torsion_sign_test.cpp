// The sign of dry friction across the transmission.
#include <algorithm>

#include <gtest/gtest.h>

#include "diagnosis/frame/baseline.hpp"
#include "diagnosis/model/model_columns.hpp"
#include "diagnosis/model/torsion_sign.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr auto kTorsion = static_cast<std::size_t>(Equation::torsion);
constexpr double kDry = 2.0;     // Nm
constexpr double kNoise = 1e-3;  // Nm, of the weights; nothing is added

/// An angle that travels, of which nothing is known but tau = kDry tanh(q'/width).
Frame rubbing_joint(double width_share) {
  Frame f = closed_form_frame();
  f.rig = Rig::specimen;
  f.travels = true;
  f.equations = {Equation::torsion};
  f.torque = kDry * (f.torsion_rate / (width_share * f.rate_range)).tanh();
  f.torque_range = f.torque.abs().maxCoeff();
  return f;
}

std::vector<SignPart> fitted(const Frame& f) {
  PerEquation weight;
  weight[kTorsion] = f.usable / kNoise;
  const DriveModel start = first_guess(f);
  const auto fit = fit_model(f, weight, {Equation::torsion}, start, reference_of(f, start), {0});
  EXPECT_TRUE(fit.has_value());
  return torsion_sign(f, fit->model);
}

TEST(TorsionSign, OfAJointIsThatOfItsDryFriction) {
  // Half way between two widths the best mixture of both is off by 0.6 % (a minimax over all
  // rates); that of least squares by a third more at most on rates that are not spread evenly.
  for (const double share : {0.008, 0.0095, 0.0269, 0.0381}) {
    const Frame f = rubbing_joint(share);
    const auto sign = fitted(f);
    double shares = 0.0;
    for (const SignPart& part : sign) shares += part.share;
    EXPECT_NEAR(shares, 1.0, 1e-12);
    const ArrayXd expected = f.torque / kDry;
    EXPECT_LT((rounded_sign(f.torsion_rate, sign) - expected).abs().maxCoeff(), 0.008) << share;
  }
}

// A filter that the model undoes makes the motion faster, and with it the widths of the fit.
TEST(TorsionSign, IsOfTheMotionAsTheModelSeesIt) {
  const Frame f = rubbing_joint(0.03);
  DriveModel model = first_guess(f);
  const auto parts = baseline_parts();
  const auto row = std::ranges::find(parts, "common_filter", &CauseRow::id);
  ASSERT_NE(row, parts.end());
  model.causes.push_back({&*row, &row->forms.front(), {0.02}});
  model.coefficients.emplace_back();
  PerEquation weight;
  weight[kTorsion] = f.usable / kNoise;
  const auto fit = fit_model(f, weight, {Equation::torsion}, model, reference_of(f, model), {0});
  ASSERT_TRUE(fit.has_value());
  const Reference known = reference_of(f, fit->model);
  ModelColumns columns(f, known);
  const Frame& seen = columns.seen(fit->model);
  ASSERT_GT(seen.rate_range, 1.001 * f.rate_range);
  const Eigen::VectorXd& own = fit->model.own[kTorsion];
  const Index widths = static_cast<Index>(dry_widths(seen.rate_range).size());
  const double dry = own.segment(own.size() - 1 - widths, widths).sum();
  const ArrayXd viscous = own[own.size() - 1] * seen.torsion_rate / seen.rate_range;
  const ArrayXd sign = rounded_sign(seen.torsion_rate, known.torsion_sign);
  EXPECT_LT((known.dissipative - viscous - dry * sign).abs().maxCoeff(), 1e-10 * kDry);
}

TEST(TorsionSign, OfAMirroredJointIsTheSame) {
  const Frame f = rubbing_joint(0.03);
  Frame mirrored = f;
  mirrored.torsion = -f.torsion;
  mirrored.torsion_rate = -f.torsion_rate;
  mirrored.torque = -f.torque;
  mirrored.lowest = -f.highest;
  mirrored.highest = -f.lowest;
  const auto a = fitted(f), b = fitted(mirrored);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_DOUBLE_EQ(a[k].width, b[k].width);
    EXPECT_NEAR(a[k].share, b[k].share, 1e-6);
  }
}

TEST(TorsionSign, IsNarrowWhereNothingIsFittedOrNothingTravels) {
  Frame f = rubbing_joint(0.03);
  const auto before = torsion_sign(f, first_guess(f));
  ASSERT_EQ(before.size(), 1U);
  EXPECT_DOUBLE_EQ(before[0].width, 0.01 * f.rate_range);
  f.travels = false;
  f.slow_rate = 0.004 * f.rate_range;
  const auto wound = torsion_sign(f, first_guess(f));
  ASSERT_EQ(wound.size(), 1U);
  EXPECT_DOUBLE_EQ(wound[0].width, f.slow_rate);
}

}  // namespace
}  // namespace flexspline::studies
