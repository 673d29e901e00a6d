// Which speeds an encoder tells.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "diagnosis/frame/counted.hpp"

namespace flexspline::studies {
namespace {

constexpr double kInterval = 1e-3;
constexpr double kLevel = 0.01;
constexpr double kBandwidth = 60.0;
constexpr double kSlowest = kLevel * kBandwidth / std::numbers::pi;  // two levels in a period

struct Told {
  std::vector<double> time, tells;
};

Told told(const std::function<double(double)>& angle, double level) {
  std::vector<double> time, read;
  for (int i = 0; i < 3000; ++i) {
    time.push_back(kInterval * i);
    const double x = angle(time.back());
    read.push_back(level > 0.0 ? level * std::round(x / level) : x);
  }
  auto tells = counted(time, read, kBandwidth);
  return {std::move(time), std::move(tells)};
}

double share(const Told& t) {
  double sum = 0.0;
  for (const double one : t.tells) sum += one;
  return sum / static_cast<double>(t.tells.size());
}

TEST(Counted, ASteadySpeedIsToldFromTwoLevelsAPeriodOn) {
  const auto steady = [](double times) {
    return share(told([=](double t) { return times * kSlowest * t; }, kLevel));
  };
  EXPECT_EQ(steady(0.4), 0.0) << "never two levels";
  EXPECT_LT(steady(0.8), 0.9);
  EXPECT_GT(steady(1.5), 0.97) << "all but half a period at either end";
}

// A motor that creeps past a level now and then looks, smoothed, as if it moved and rested.
TEST(Counted, CreepingIsNotTold) {
  const auto creep = [](double t) { return 0.05 * kSlowest * t + 0.2 * kLevel; };
  EXPECT_EQ(share(told(creep, kLevel)), 0.0);
}

// About a reversal to where a motion v^2/(2 a) away has passed two levels.
TEST(Counted, AReversalIsNotTold) {
  const auto turn = [](double t) { return 0.5 * 0.5 * std::pow(t - 1.5, 2.0); };
  const Told t = told(turn, kLevel);
  const double half = std::numbers::pi / kBandwidth;
  const double near = kLevel / (0.5 * half);  // 2 half a d = 2 levels
  for (std::size_t i = 0; i < t.time.size(); ++i) {
    const double from = std::abs(t.time[i] - 1.5);
    if (from < 0.4 * near) EXPECT_EQ(t.tells[i], 0.0) << t.time[i];
    if (from > 1.6 * near && from < 1.4) EXPECT_EQ(t.tells[i], 1.0) << t.time[i];
  }
}

// A smoothing that takes nothing away keeps what is as fast as every other sample, and no faster.
TEST(Counted, NoSmoothingIsTwoSamples) {
  std::vector<double> time, angle;
  for (int i = 0; i < 500; ++i)
    time.push_back(kInterval * i), angle.push_back(kLevel * (i + i / 100));
  const auto tells = counted(time, angle, std::numeric_limits<double>::infinity());
  EXPECT_EQ(std::ranges::count(tells, 1.0), 498) << "all but the ends";
}

/// A drive that moves at a speed told by its levels, then stands for as long.
Recording moved_then_stood() {
  Recording r;
  for (int i = 0; i < 4000; ++i) {
    const double angle = 20.0 * kSlowest * kInterval * std::min(i, 2000) + 1e-3;
    r.time.push_back(kInterval * i);
    r.channels[Quantity::motor_angle].push_back(kLevel * std::round(angle / kLevel));
    r.channels[Quantity::load_angle].push_back(1e-4 * std::round(angle / 50.0 / 1e-4));
  }
  return r;
}

// Uniform within a level, of both encoders: no mean over a standing count makes it smaller.
TEST(TorsionError, OfAnAngleThatRestsIsThatOfItsLevel) {
  const Recording r = moved_then_stood();
  DriveChannels smooth;
  smooth.motor_bandwidth = kBandwidth;
  smooth.torsion_error.assign(r.time.size(), 3e-6);
  smooth.motor_angle_error.assign(r.time.size(), 5e-4);
  const auto free = torsion_error(r, Rig::free, 50.0, smooth);
  const double levels = std::hypot(kLevel / 50.0, 1e-4) / std::sqrt(12.0);
  EXPECT_DOUBLE_EQ(free[1000], 3e-6);
  EXPECT_NEAR(free[3000], std::hypot(3e-6, levels), 1e-12);
  const auto locked = torsion_error(r, Rig::locked, 50.0, smooth);
  EXPECT_DOUBLE_EQ(locked[1000], 5e-4 / 50.0);
  EXPECT_GT(locked[3000], kLevel / 50.0 / std::sqrt(12.0));
  EXPECT_EQ(torsion_error(r, Rig::specimen, 1.0, smooth), smooth.torsion_error);
}

TEST(Counted, AnAngleWithoutLevelsIsToldEverywhere) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> noise(0.0, 1e-4);
  EXPECT_GT(share(told([&](double t) { return std::sin(3.0 * t) + noise(engine); }, 0.0)), 0.999);
}

}  // namespace
}  // namespace flexspline::studies
