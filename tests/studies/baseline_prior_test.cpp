// What the baseline says where no row tells: it goes on as it came.
#include <gtest/gtest.h>

#include "diagnosis/frame/shared_baseline.hpp"
#include "diagnosis/search/search.hpp"
#include "drive_frame.hpp"
#include "flexspline/core/estimate.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kStiffness = 2e4;  // Nm/rad
constexpr double kNoise = 0.5;      // Nm
constexpr auto kTorsion = static_cast<std::size_t>(Equation::torsion);

/// Wound up in closed form against a linear spring and a viscous friction.
Frame wound() {
  Frame f = closed_form_frame();
  f.equations = {Equation::torsion};
  const double viscous = 0.05 * kStiffness * f.torsion_range / f.rate_range;
  f.torque = kStiffness * f.torsion + viscous * f.torsion_rate;
  f.torque_range = f.torque.abs().maxCoeff();
  return f;
}

/// Largest error of the fit to some rows on the others, over the largest torque.
double error_beyond(const Frame& exact, const ArrayXd& inside, std::uint64_t seed) {
  Frame f = exact;
  f.torque += kNoise * normal(f.rows(), seed);
  PerEquation weight;
  weight[kTorsion] = f.usable * inside / kNoise;
  const DriveModel start = first_guess(f);
  const auto fit = fit_model(f, weight, {Equation::torsion}, start, reference_of(f, start), {8});
  EXPECT_TRUE(fit.has_value());
  if (!fit) return kNotComputed;
  const ArrayXd error = (fit->prediction[kTorsion] - exact.torque) * f.usable * (1.0 - inside);
  return error.abs().maxCoeff() / f.torque_range;
}

TEST(BaselinePrior, ASpringGoesOnStraightBeyondWhatTheRowsSee) {
  const Frame f = wound();
  for (const std::uint64_t seed : {3, 4, 5}) {
    const ArrayXd inside = (f.torsion.abs() < 0.8 * f.torsion_range).cast<double>();
    EXPECT_LT(error_beyond(f, inside, seed), 0.1) << "a spring that ends there lacks a fifth";
  }
}

// A law that bends by as much as its mean slope at every knot is within it: fitted rows move by
// less than a tenth of their noise.
TEST(BaselinePrior, IsNothingBesideRowsThatTell) {
  Frame f = wound();
  const double range = f.torsion_range;
  f.torque = kStiffness * range * (f.torsion / range).cube();
  f.torque_range = f.torque.abs().maxCoeff();
  const ArrayXd all = ArrayXd::Ones(f.rows());
  PerEquation weight;
  weight[kTorsion] = f.usable / kNoise;
  const DriveModel start = first_guess(f);
  const auto fit = fit_model(f, weight, {Equation::torsion}, start, reference_of(f, start), {0});
  ASSERT_TRUE(fit.has_value());
  EXPECT_LT((fit->residual[kTorsion] * f.usable).abs().maxCoeff(), 0.1 * kNoise);
}

TEST(BaselinePrior, HasTheRowsThatFitsCountOn) {
  for (const Rig rig : {Rig::locked, Rig::free, Rig::specimen, Rig::servo}) {
    const Frame f = drawn_frame(rig);
    for (const Equation equation : f.equations) {
      const DriveModel start = first_guess(f);
      const BaselineColumns c = baseline_columns(f, equation, start.torsion_shape);
      EXPECT_EQ(c.prior.rows(), prior_rows(f, equation));
      EXPECT_EQ(c.prior.cols(), c.columns.cols());
    }
  }
}

}  // namespace
}  // namespace flexspline::studies
