// Dry friction against motions with a closed form.
#include "flexspline/core/stick_slip.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "claims/claims.hpp"
#include "ode_examples.hpp"

namespace flexspline {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

TEST(StickSlip, BrakesToRestWhereTheClosedFormDoes) {
  constexpr double kInertia = 0.5, kViscous = 0.8, kLevel = 0.3, kSpeed = 2.0;
  const DryFrictionDrive drive{.inertia = kInertia,
                               .viscous = kViscous,
                               .sliding_level = kLevel,
                               .static_level = kLevel,
                               .effort = [](double, double) { return 0.0; },
                               .effort_slope = {}};
  for (const double sign : {1.0, -1.0}) {
    const auto made = simulate_stick_slip(drive, instants(3.0, 10), 0.0, sign * kSpeed);
    ASSERT_TRUE(made) << made.error().message();
    const double stop = kInertia / kViscous * std::log1p(kViscous * kSpeed / kLevel);
    const double way = (kInertia * kSpeed - kLevel * stop) / kViscous;
    ASSERT_EQ(made->events.size(), 1u);
    EXPECT_NEAR(made->events[0].time, stop, 1e-7);
    EXPECT_NEAR(made->events[0].position, sign * way, 1e-7);
    EXPECT_EQ(made->events[0].to, Contact::stick);
    EXPECT_EQ(made->speed.back(), 0.0);
    EXPECT_NEAR(made->stick_share, 1.0 - stop / 3.0, 1e-7);
  }
}

TEST(StickSlip, BreaksAwayWhenARisingEffortPassesTheStaticLevel) {
  // Effort r t, no viscosity, Fs = Fc: v = r (t - Fs/r)^2 / (2 J).
  constexpr double kRise = 0.4, kLevel = 1.0, kInertia = 2.0;
  const DryFrictionDrive drive{.inertia = kInertia,
                               .sliding_level = kLevel,
                               .static_level = kLevel,
                               .effort = [](double t, double) { return kRise * t; },
                               .effort_slope = {}};
  const auto times = instants(10.0, 40);
  const auto made = simulate_stick_slip(drive, times, 0.7, 0.0);
  ASSERT_TRUE(made) << made.error().message();
  ASSERT_EQ(made->events.size(), 1u);
  EXPECT_NEAR(made->events[0].time, 2.5, 1e-9);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double since = std::max(0.0, times[i] - 2.5);
    EXPECT_NEAR(made->speed[i], kRise * since * since / (2.0 * kInertia), 1e-7);
    EXPECT_NEAR(made->position[i], 0.7 + kRise * since * since * since / (6.0 * kInertia), 1e-7);
  }
}

TEST(StickSlip, LosesTwoFcOverKInEachHalfSwing) {
  // A mass on a spring turns at multiples of pi / w and sticks once k |x| <= Fs.
  constexpr double kStiffness = 9.0, kInertia = 1.0, kLevel = 0.45;  // 2 Fc / k = 0.1
  const DryFrictionDrive drive{.inertia = kInertia,
                               .sliding_level = kLevel,
                               .static_level = kLevel,
                               .effort = [](double, double x) { return -kStiffness * x; },
                               .effort_slope = [](double, double) { return -kStiffness; }};
  const auto made = simulate_stick_slip(drive, instants(12.0, 50), 1.03, 0.0);
  ASSERT_TRUE(made) << made.error().message();
  ASSERT_EQ(made->events.size(), 10u) << "turns at -0.93, 0.83, ... and sticks at 0.03";
  for (std::size_t k = 0; k < made->events.size(); ++k) {
    const double sign = k % 2 == 0 ? -1.0 : 1.0;
    EXPECT_NEAR(made->events[k].time, static_cast<double>(k + 1) * pi / 3.0, 1e-6);
    EXPECT_NEAR(made->events[k].position, sign * (0.93 - 0.1 * static_cast<double>(k)), 1e-6);
  }
  EXPECT_EQ(made->events.back().to, Contact::stick);
  EXPECT_NEAR(made->stick_share, 1.0 - 10.0 * pi / 3.0 / 12.0, 1e-6);
}

// A mass on a belt of speed V, held by a spring, seen from the belt.
DryFrictionDrive mass_on_belt(double stribeck_speed) {
  return {.inertia = 1.0,
          .sliding_level = 0.5,
          .static_level = 0.8,
          .stribeck_speed = stribeck_speed,
          .effort = [](double t, double x) { return -4.0 * (x + 0.1 * t); },
          .effort_slope = [](double, double) { return -4.0; }};
}

TEST(StickSlip, OfAMassOnABeltHasTheClosedFormPeriod) {
  constexpr double kStiffness = 4.0, kBelt = 0.1, kFrequency = 2.0, kExcess = 0.3;
  const auto made = simulate_stick_slip(mass_on_belt(0.0), instants(40.0, 400), 0.0, 0.0);
  ASSERT_TRUE(made) << made.error().message();
  const double stick = 2.0 * kExcess / (kStiffness * kBelt);
  const double slip =
      2.0 / kFrequency * (pi - std::atan(kFrequency * kExcess / (kStiffness * kBelt)));
  const auto& events = made->events;
  ASSERT_GT(events.size(), 20u);
  EXPECT_NEAR(events[0].time, 0.8 / (kStiffness * kBelt), 1e-9) << "first break-away, from rest";
  for (std::size_t k = 1; k + 1 < events.size(); ++k) {
    const bool slipped = events[k].to == Contact::stick;
    EXPECT_NEAR(events[k].time - events[k - 1].time, slipped ? slip : stick, 1e-6) << "event " << k;
  }
}

TEST(StickSlip, ErrsInProportionToItsTolerance) {
  const double slip = pi - std::atan(1.5);
  std::vector<double> errors;
  for (const double tolerance : {1e-8, 1e-10, 1e-12}) {
    StickSlipSettings how;
    how.relative_tolerance = tolerance;
    how.position_tolerance = how.speed_tolerance = 1e-2 * tolerance;
    const auto made = simulate_stick_slip(mass_on_belt(0.0), instants(30.0, 2), 0.0, 0.0, how);
    ASSERT_TRUE(made);
    errors.push_back(std::abs(made->events[15].time - (2.0 + 8.0 * slip + 7.0 * 1.5)));
    std::printf("eighth slip at %.0e: %.1e s late\n", tolerance, errors.back());
    EXPECT_LT(errors.back(), 1e4 * tolerance) << "after eight slips, each adding its own";
  }
  EXPECT_LT(errors[1], 0.05 * errors[0]);
  EXPECT_LT(errors[2], 0.05 * errors[1]);
  claims::expect("docs/simulation.md", "slip-events",
                 {{"at 1e-8", errors[0]}, {"at 1e-10", errors[1]}, {"at 1e-12", errors[2]}});
}

TEST(StickSlip, WithStribeckApproachesTheSuddenFall) {
  const auto sudden = simulate_stick_slip(mass_on_belt(0.0), instants(20.0, 2), 0.0, 0.0);
  ASSERT_TRUE(sudden);
  std::vector<double> errors;
  for (const double speed : {0.04, 0.02, 0.01}) {
    const auto made = simulate_stick_slip(mass_on_belt(speed), instants(20.0, 2), 0.0, 0.0);
    ASSERT_TRUE(made) << made.error().message();
    ASSERT_GT(made->events.size(), 3u);
    errors.push_back(std::abs(made->events[3].time - sudden->events[3].time));
  }
  EXPECT_LT(errors[1], 0.75 * errors[0]);
  EXPECT_LT(errors[2], 0.75 * errors[1]);
}

TEST(StickSlip, StaysWhereTheEffortNeverPassesTheStaticLevel) {
  const DryFrictionDrive drive{.sliding_level = 0.5,
                               .static_level = 1.0,
                               .effort = [](double t, double) { return 0.999 * std::sin(t); },
                               .effort_slope = {}};
  const auto made = simulate_stick_slip(drive, instants(50.0, 10), 0.2, 0.0);
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->events.empty());
  EXPECT_NEAR(made->stick_share, 1.0, 1e-12);
  EXPECT_EQ(made->position.back(), 0.2);
}

TEST(StickSlip, RefusesADriveOutsideItsRanges) {
  auto drive = mass_on_belt(0.0);
  drive.static_level = 0.4;
  const auto made = simulate_stick_slip(drive, instants(1.0, 2), 0.0, 0.0);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::bad_data);
  EXPECT_THAT(made.error().message(), HasSubstr("static_level = 0.4"));
  const double back[] = {0.0, 1.0, 1.0};
  EXPECT_FALSE(simulate_stick_slip(mass_on_belt(0.0), back, 0.0, 0.0));
  EXPECT_FALSE(simulate_smoothed(mass_on_belt(0.0), 0.0, instants(1.0, 2), 0.0, 0.0));
}

TEST(StickSlip, SaysWhenItChattersTooOften) {
  StickSlipSettings how;
  how.max_events = 3;
  const auto made = simulate_stick_slip(mass_on_belt(0.0), instants(40.0, 2), 0.0, 0.0, how);
  ASSERT_FALSE(made);
  EXPECT_THAT(made.error().message(), HasSubstr("stick and slip changed 4 times up to t = "));
}

}  // namespace
}  // namespace flexspline
