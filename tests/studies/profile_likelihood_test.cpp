#include "answers/profile_likelihood.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace flexspline::studies {
namespace {

/// The cost of a linear model: a parabola of the covariance's.
ProfileInput linear(double estimate, double std, const std::vector<double>& values,
                    double noise_factor = 1.0) {
  ProfileInput input{estimate, std, {}};
  for (const double one : values) {
    input.held.push_back({one, noise_factor * std::pow((one - estimate) / std, 2)});
  }
  return input;
}

TEST(ProfileLikelihood, OfALinearModelIsTheParabolaOfItsCovariance) {
  const ProfileLikelihood profile(linear(3.0, 0.2, {1.0, 2.9, 3.4, 9.0}));
  for (const double at : {1.0, 2.0, 2.95, 3.0, 3.1, 8.0}) {
    EXPECT_NEAR(profile.rise(at), std::pow((at - 3.0) / 0.2, 2), 1e-9) << at;
  }
  EXPECT_NEAR(profile.lower().value(), 3.0 - 1.959963984540054 * 0.2, 1e-12);
  EXPECT_NEAR(profile.upper().value(), 3.0 + 1.959963984540054 * 0.2, 1e-12);
  EXPECT_NEAR(profile.widening(), 1.0, 1e-12);
  EXPECT_TRUE(std::isnan(profile.rise(0.9)));
}

// Noise with memory: residuals rise four times as fast as their covariance allows.
TEST(ProfileLikelihood, TakesTheCovariancesWordOnNoiseWithMemory) {
  const ProfileLikelihood profile(linear(0.0, 1.0, {-5.0, -0.5, 0.5, 5.0}, 4.0));
  EXPECT_NEAR(profile.widening(), 2.0, 1e-12);
  EXPECT_NEAR(profile.upper().value(), 1.959963984540054, 1e-12);
}

// sigma of a normal sample: -2 ln L = 2 n ln s + n (s0/s)^2 + const, whose 95 % interval is known.
TEST(ProfileLikelihood, IsAsCrookedAsTheLikelihood) {
  const double n = 20.0;
  const auto rise = [&](double s) { return 2.0 * n * std::log(s) + n / (s * s) - n; };
  ProfileInput input{1.0, 1.0 / std::sqrt(2.0 * n), {}};
  for (double s = 0.4; s < 2.5; s += 0.02) {
    if (std::abs(s - 1.0) > 1e-9) input.held.push_back({s, rise(s)});
  }
  const ProfileLikelihood profile(input);
  EXPECT_NEAR(rise(profile.lower().value()), kProfileRise, 0.03);
  EXPECT_NEAR(rise(profile.upper().value()), kProfileRise, 0.03);
  EXPECT_GT(profile.upper().value() - 1.0, 1.0 - profile.lower().value());
}

TEST(ProfileLikelihood, OfAFlatCostBoundsNothing) {
  ProfileInput input{0.0, 1e6, {{-1.0, 0.0}, {-0.5, 0.0}, {0.5, 0.0}, {1.0, 0.1}}};
  const ProfileLikelihood profile(input);
  EXPECT_FALSE(profile.lower());
  EXPECT_FALSE(profile.upper());
}

}  // namespace
}  // namespace flexspline::studies
