// Where a specimen is unloaded, friction says for each way of its own.
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "diagnosis/frame/frame.hpp"

namespace flexspline::studies {
namespace {

/// A damper whose dry friction is most of its force, mounted at `zero`, cut off within a cycle.
RecordingSet damper(const std::vector<double>& zeros) {
  RecordingSet set;
  set.name = "damper";
  set.rig = Rig::specimen;
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.2);
  for (std::size_t k = 0; k < zeros.size(); ++k) {
    Recording& r = set.recordings.emplace_back();
    r.id = "sine-" + std::to_string(k);
    const double cycles = 2.3 + 0.2 * static_cast<double>(k);
    for (int i = 0; i < 1500; ++i) {
      const double t = cycles * i / 1500.0;
      const double phase = 2.0 * std::numbers::pi * t;
      const double x = 0.01 * std::sin(phase);
      r.time.push_back(t);
      r.channels[Quantity::displacement].push_back(x + zeros[k]);
      r.channels[Quantity::force].push_back(5e3 * x + 80.0 * std::tanh(20.0 * std::cos(phase)) +
                                            noise(random));
    }
  }
  return set;
}

TEST(ZerosByFriction, AreThatOfBothWays) {
  const auto alike = make_frame(damper({0.0, 0.0, 0.0, 0.0}), 8000);
  ASSERT_TRUE(alike);
  EXPECT_FALSE(alike->own_zeros);
  const auto apart = make_frame(damper({0.0, 4e-3, 0.0, -4e-3}), 8000);
  ASSERT_TRUE(apart);
  EXPECT_TRUE(apart->own_zeros);
}

}  // namespace
}  // namespace flexspline::studies
