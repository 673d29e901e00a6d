// What of an error held out is noise, where some motions are not known.
#include <gtest/gtest.h>

#include "diagnosis/proof/held_out_error.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

constexpr double kNoise = 0.2;   // Nm
constexpr double kMotion = 5.0;  // Nm

/// Errors of the motion in one row of ten.
ArrayXd of_motion(const Frame& f) {
  return ArrayXd::NullaryExpr(f.rows(), [](Eigen::Index r) { return r % 10 == 0 ? kMotion : 0.0; });
}

EquationNoise noise(const Frame& f, ArrayXd motion) {
  return {.level = std::vector(f.segments.size(), kNoise), .of_motion = std::move(motion)};
}

TEST(HeldOutNoise, IsTheNoisesRootMeanSquareWhereMotionsAreKnown) {
  const Frame f = closed_form_frame();
  const ArrayXd rows = ArrayXd::Ones(f.rows());
  EXPECT_NEAR(noise_of(f, noise(f, {}), 3.0 * normal(f.rows(), 1), rows), kNoise, 1e-12);
}

// An error of no more than noise and motions is noise, though its root mean square is the motions'.
TEST(HeldOutNoise, CountsEachRowByWhatItsMotionIsKnownTo) {
  const Frame f = closed_form_frame();
  const ArrayXd rows = ArrayXd::Ones(f.rows());
  const ArrayXd residual = kNoise * normal(f.rows(), 1) + of_motion(f) * normal(f.rows(), 2);
  const double of_all =
      rms_on(residual, rows) / noise_of(f, noise(f, of_motion(f)), residual, rows);
  EXPECT_NEAR(of_all, 1.0, 0.1);  // of some hundred rows a deviation is known to a twentieth
  // A misfit of the rows that are known is not hidden by those that are not.
  const ArrayXd missed = residual + 3.0 * kNoise;
  const double of_missed = rms_on(missed, rows) / noise_of(f, noise(f, of_motion(f)), missed, rows);
  EXPECT_GT(of_missed, 2.5) << "nine rows of ten are off by three deviations: the root of 9.1";
}

TEST(HeldOutNoise, IsKnownWhereMotionsDoNoMore) {
  const Frame f = closed_form_frame();
  const ArrayXd known = motion_is_known(f, noise(f, of_motion(f)));
  EXPECT_NEAR(known.mean(), 0.9, 0.01);
  EXPECT_EQ(motion_is_known(f, noise(f, {})).minCoeff(), 1.0);
}

}  // namespace
}  // namespace flexspline::studies
