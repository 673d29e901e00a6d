// What smoothing the sign of dry friction costs, on a locked rotor in deg and Nm driven at 0.05 Hz.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "flexspline/core/stick_slip.hpp"
#include "ode_examples.hpp"

namespace flexspline {
namespace {

using std::numbers::pi;

DryFrictionDrive locked_rotor(double static_level, double stribeck_speed) {
  return {.inertia = 1.815 * pi / 180.0,
          .viscous = 0.5,
          .sliding_level = 2.0,
          .static_level = static_level,
          .stribeck_speed = stribeck_speed,
          .effort =
              [](double t, double x) {
                return 16.5 * std::sin(2.0 * pi * 0.05 * t) - 14.133 * x - 1.5e3 * x * x * x;
              },
          .effort_slope = [](double, double x) { return -14.133 - 4.5e3 * x * x; }};
}

// The speed range is 0.06 deg/s.
double smoothing_error(const DryFrictionDrive& drive, double width) {
  StickSlipSettings how;
  how.relative_tolerance = 1e-8;
  how.position_tolerance = how.speed_tolerance = 1e-11;
  const auto made = simulate_smoothed(drive, width, instants(60.0, 1200), 0.0, 0.0, how);
  EXPECT_TRUE(made) << (made ? "" : made.error().message());
  return made ? made->error : NAN;
}

TEST(SmoothedFriction, ErrsInProportionToItsWidthWhereStaticIsSliding) {
  const auto drive = locked_rotor(2.0, 0.0);
  const double wide = smoothing_error(drive, 1e-2);
  const double middle = smoothing_error(drive, 1e-3);
  const double narrow = smoothing_error(drive, 1e-4);
  EXPECT_LT(wide, 0.1);
  EXPECT_LT(middle, 0.3 * wide);
  EXPECT_LT(narrow, 0.2 * middle);
  EXPECT_LT(narrow, 2e-3);
}

// tanh(u) (Fc + (Fs - Fc) exp(-(u / 10)^2)) never reaches Fs, whatever the width in u = v / width.
TEST(SmoothedFriction, DoesNotConvergeWhereStaticFallsToSlidingWithinTheWidth) {
  const auto drive = locked_rotor(2.6, 0.0);
  const double wide = smoothing_error(drive, 1e-2);
  const double narrow = smoothing_error(drive, 1e-4);
  EXPECT_GT(narrow, 0.04);
  EXPECT_GT(narrow, 0.3 * wide) << "a hundred times narrower";
}

TEST(SmoothedFriction, ConvergesOnceItsWidthIsSmallAgainstTheStribeckSpeed) {
  const auto drive = locked_rotor(2.6, 0.1);
  const double wide = smoothing_error(drive, 1e-2);
  const double narrow = smoothing_error(drive, 1e-4);
  EXPECT_GT(wide, 0.05);
  EXPECT_LT(narrow, 0.2 * wide);
  EXPECT_GT(narrow, 3.0 * smoothing_error(locked_rotor(2.0, 0.0), 1e-4))
      << "still worse than without a static excess";
}

}  // namespace
}  // namespace flexspline
