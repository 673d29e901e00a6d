// The memory behind reconstruct(): what is asked for again is not computed again, and nothing else
// is taken for it.
#include "flexspline/core/remembered.hpp"

#include <atomic>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

#include "flexspline/core/signals.hpp"
#include "loop_records.hpp"

namespace flexspline {
namespace {

TorsionRecord record_of(double first) {
  TorsionRecord record;
  record.id = "one";
  record.time = {0.0, 1.0, 2.0};
  record.motion = {first, 1.0, 0.0};
  record.effort = {0.0, 2.0, std::numeric_limits<double>::quiet_NaN()};
  return record;
}

class RememberedCount : public testing::Test {
 protected:
  int ask(const TorsionRecord& record) {
    return *remembered_.of(content_of(record), [&] { return ++computed_; });
  }

  std::atomic<int> computed_ = 0;
  Remembered<int> remembered_{std::size_t{1} << 20U};
};

TEST_F(RememberedCount, ComputesTheSameSamplesOnceWhateverTheyAreCalled) {
  TorsionRecord again = record_of(1.0);
  again.id = "two";
  again.split = Split::holdout;
  again.valid = {true, false, true};
  EXPECT_EQ(ask(record_of(1.0)), 1);
  EXPECT_EQ(ask(again), 1);
}

TEST_F(RememberedCount, TellsApartWhatDiffersByOneBit) {
  EXPECT_EQ(ask(record_of(1.0)), 1);
  EXPECT_EQ(ask(record_of(std::nextafter(1.0, 2.0))), 2);
  TorsionRecord other = record_of(1.0);
  other.frequency_hz = 0.1;
  EXPECT_EQ(ask(other), 3);
  other.travels = true;
  EXPECT_EQ(ask(other), 4);
  std::swap(other.motion, other.effort);
  EXPECT_EQ(ask(other), 5);
}

TEST_F(RememberedCount, ComputesOnceForAllThatWaitForIt) {
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&] {
        for (int k = 0; k < 50; ++k) EXPECT_EQ(ask(record_of(1.0)), 1);
      });
    }
  }
  EXPECT_EQ(computed_, 1);
}

TEST(Remembered, ForgetsTheOldestWhenFull) {
  int computed = 0;
  Remembered<int> two(2 * content_of(record_of(1.0)).bytes());
  const auto ask = [&](double first) {
    return *two.of(content_of(record_of(first)), [&] { return ++computed; });
  };
  EXPECT_EQ(ask(1.0), 1);
  EXPECT_EQ(ask(2.0), 2);
  EXPECT_EQ(ask(3.0), 3);
  EXPECT_EQ(ask(2.0), 2);
  EXPECT_EQ(ask(1.0), 4);
}

TEST(Remembered, LeavesOutWhatIsLargerThanAllOfIt) {
  int computed = 0;
  Remembered<int> none(1);
  for (int i = 1; i < 3; ++i)
    EXPECT_EQ(*none.of(content_of(record_of(1.0)), [&] { return ++computed; }), i);
}

TEST(Remembered, AReconstructionComesBackBitForBit) {
  auto record = sine_record(3, 200, [](double x, double v) { return 5.0 * x + 0.1 * v; });
  add_noise(record.motion, 0.01, 1);
  const auto first = reconstruct(record);
  record.id = "again";
  const auto second = reconstruct(record);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->motion.velocity, second->motion.velocity);
  record.motion[50] += 0.01;
  EXPECT_NE(reconstruct(record)->motion.velocity, first->motion.velocity);
}

}  // namespace
}  // namespace flexspline
