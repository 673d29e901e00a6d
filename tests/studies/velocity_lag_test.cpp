// A recorded velocity against the slope of the angle: filters of known order and time constant, by
// the complex amplitudes of sines.
#include <cmath>
#include <complex>
#include <random>

#include <gtest/gtest.h>

#include "diagnosis/frame/velocity_lag.hpp"

namespace flexspline::studies {
namespace {

using Complex = std::complex<double>;

/// Two sines, 0.4 and 1.5 Hz, one a recording; their starts do not count.
Frame two_sines() {
  constexpr Eigen::Index rows = 2000;
  Frame f;
  f.rig = Rig::specimen;
  f.interval = 0.01;
  f.time = Eigen::ArrayXd(2 * rows);
  f.load_speed = f.velocity = f.torsion_rate = f.torsion_acceleration = f.usable = f.time;
  for (Eigen::Index s = 0; s < 2; ++s) {
    const double omega = 2.0 * M_PI * (s == 0 ? 0.4 : 1.5);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const Eigen::Index r = s * rows + i;
      f.time[r] = f.interval * static_cast<double>(i);
      f.load_speed[r] = std::cos(omega * f.time[r]);
      f.torsion_acceleration[r] = -omega * std::sin(omega * f.time[r]);
      f.usable[r] = f.time[r] > 1.0 ? 1.0 : 0.0;
    }
    f.segments.push_back({s == 0 ? "slow" : "fast", s * rows, rows});
  }
  f.torsion_rate = f.velocity = f.load_speed;
  return f;
}

Frame behind(int filters, double time_constant) {
  Frame f = two_sines();
  for (const Segment& s : f.segments) {
    const double omega = 2.0 * M_PI * (s.id == "slow" ? 0.4 : 1.5);
    const Complex gain = std::pow(Complex(1.0, omega * time_constant), -filters);
    for (Eigen::Index r = s.first; r < s.first + s.count; ++r) {
      f.velocity[r] = std::real(gain * std::polar(1.0, omega * f.time[r]));
    }
  }
  return f;
}

TEST(VelocityLag, FiltersAreFoundByOrderAndTimeConstant) {
  for (int filters : {1, 2}) {
    const auto lag = velocity_lag(behind(filters, 0.07));
    ASSERT_TRUE(lag) << filters;
    EXPECT_EQ(lag->filters, filters);
    EXPECT_NEAR(lag->time_constant, 0.07, 3e-4) << "signals are lines between rows";
    EXPECT_LT(lag->after, 0.002);
    EXPECT_GT(lag->before, 0.3);
  }
}

TEST(VelocityLag, TheSlopeItselfAndItsNoiseAreNone) {
  Frame f = two_sines();
  EXPECT_FALSE(velocity_lag(f));
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (double& w : f.velocity) w += 0.1 * normal(random);
  EXPECT_FALSE(velocity_lag(f));
}

// A filter of first order passes at most the real part of its gain: a scale is not taken for one.
TEST(VelocityLag, AnotherUnitOrADeadChannelIsNone) {
  for (double scale : {57.3, -1.0, 0.3, 0.0}) {
    Frame f = two_sines();
    f.velocity *= scale;
    EXPECT_FALSE(velocity_lag(f)) << scale;
  }
}

TEST(VelocityLag, RecordingsWithoutAVelocityHaveNoSay) {
  Frame f = behind(1, 0.07);
  f.velocity.tail(f.rows() / 2) = std::nan("");
  const auto lag = velocity_lag(f);
  ASSERT_TRUE(lag);
  EXPECT_NEAR(lag->time_constant, 0.07, 3e-4);
  f.velocity = std::nan("");
  EXPECT_FALSE(velocity_lag(f));
  f.velocity.resize(0);
  EXPECT_FALSE(velocity_lag(f));
}

TEST(VelocityLag, IsSaidInWords) {
  const std::string words =
      in_words({.filters = 2, .time_constant = 0.0384, .before = 0.31, .after = 0.021});
  EXPECT_NE(words.find("two filters of 0.038 s each"), std::string::npos) << words;
  EXPECT_NE(words.find("31 %"), std::string::npos) << words;
}

}  // namespace
}  // namespace flexspline::studies
