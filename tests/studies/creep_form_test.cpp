// One spring that relaxes, of any time constant: closed form.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "diagnosis/search/search.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kStiffness = 3e3;  // Nm/rad
constexpr double kTime = 0.37;      // s, between two of the fixed grid

/// s' = phi' - s/T by steps far below a row's, its torsion a cubic between rows.
ArrayXd relaxing(const Frame& f) {
  constexpr int kSteps = 200;
  ArrayXd s = ArrayXd::Zero(f.rows());
  for (const Segment& part : f.segments) {
    for (Index r = part.first + 1; r < part.first + part.count; ++r) {
      const double h = (f.time[r] - f.time[r - 1]) / kSteps;
      s[r] = s[r - 1];
      for (int k = 0; k < kSteps; ++k) {
        const double share = (k + 0.5) / kSteps;
        const double rate = f.torsion_rate[r - 1] * (1.0 - share) + f.torsion_rate[r] * share;
        s[r] += h * (rate - s[r] / kTime);
      }
    }
  }
  return s;
}

TEST(ViscoelasticCreep, OfOneSpringHasItsTimeConstant) {
  Frame f = closed_form_frame(4000, 4e-3);
  f.equations = {Equation::torsion};
  const ArrayXd laws = 2e4 * f.torsion + 20.0 * f.torsion_rate;
  f.torque = laws + kStiffness * relaxing(f);
  f.torque += 1e-4 * f.torque.abs().maxCoeff() * normal(f.rows(), 9);
  f.smooth_torque = f.told_torque = f.torque;
  f.torque_range = f.torque.abs().maxCoeff();
  auto findings = fit_baseline(f);
  ASSERT_TRUE(findings.has_value());
  const CauseRow& row = *std::ranges::find(causes(), "viscoelastic_creep", &CauseRow::id);
  const auto fit =
      extended(f, *findings, {&row, forms_on(row, f).front(), {2.0 * f.interval * 20.0}}, 30);
  ASSERT_TRUE(fit.has_value()) << fit.error().message();
  EXPECT_NEAR(fit->model.causes.back().shape[0], kTime, 0.02 * kTime);
  EXPECT_NEAR(fit->model.coefficients.back()[0], kStiffness, 0.02 * kStiffness);
}

}  // namespace
}  // namespace flexspline::studies
