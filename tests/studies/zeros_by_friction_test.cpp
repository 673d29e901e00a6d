// Where a specimen is unloaded, friction says for each way of its own.
#include <algorithm>
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

TEST(ZerosByFriction, TellWhatWasRecorded) {
  const std::vector<double> zeros = {0.0, 4e-3, 0.0, -4e-3};
  for (const auto& set : {damper(zeros), damper({6e-3, 6e-3})}) {
    const auto frame = make_frame(set, 8000);
    ASSERT_TRUE(frame);
    ASSERT_NE(frame->own_zeros, frame->zero != 0.0);
    for (const Segment& s : frame->segments) {
      const auto recording = std::ranges::find(set.recordings, s.id, &Recording::id);
      const auto& recorded = *recording->find(Quantity::displacement);
      for (Eigen::Index i = 0; i < s.count; ++i) {
        ASSERT_NEAR(frame->torsion[s.first + i] + frame->zero + s.zero,
                    recorded[static_cast<std::size_t>(i)], 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace flexspline::studies
