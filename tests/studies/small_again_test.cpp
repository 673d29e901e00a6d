// What was too small to be named when it was accepted is judged again beside what came after it.
#include <stdexcept>
#include <string_view>

#include <gtest/gtest.h>

#include "diagnosis/search/selection.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

ActiveCause cause_named(std::string_view id, const Frame& frame) {
  for (const CauseRow& row : causes()) {
    if (row.id == id) return {&row, forms_on(row, frame).front(), {}};
  }
  throw std::logic_error("no such cause");
}

class SmallAgain : public testing::Test {
 protected:
  /// An offset of the motor's torque of that share of the largest, accepted at a gain of 22 less a
  /// price of 10 and too small then; worth `gain` in the end.
  bool is_material(double share, double gain) const {
    Selection s;
    s.baseline = s.final = *fit_baseline(frame_);
    DriveModel& model = s.final.fit.model;
    model.causes = {cause_named("motor_torque_offset", frame_)};
    model.coefficients = {Eigen::VectorXd::Constant(1, share * largest_)};
    Accepted accepted;
    accepted.trial.cause = model.causes.front();
    accepted.trial.gain = gain;
    accepted.trial.net_gain = 12.0;
    accepted.first_gain = 22.0;
    accepted.material = false;
    s.accepted = {accepted};
    judge_small_again(frame_, {}, s);
    EXPECT_DOUBLE_EQ(s.accepted.front().trial.net_gain, gain - 10.0);
    EXPECT_NEAR(s.accepted.front().trial.size, share, 1e-9);
    judge_small_again(frame_, {}, s);
    EXPECT_DOUBLE_EQ(s.accepted.front().trial.net_gain, gain - 10.0) << "the same, judged twice";
    return s.accepted.front().material;
  }

  const Frame frame_ = drawn_frame(Rig::free);
  const double largest_ = frame_.largest_torque(Equation::motor);
};

TEST_F(SmallAgain, BecomesANameOnlyWhereItIsLargeAndWorthIt) {
  const Limits limits;
  const double enough = limits.named_gain + 10.0;
  EXPECT_TRUE(is_material(2.0 * limits.interest, enough + 1.0));
  EXPECT_FALSE(is_material(2.0 * limits.interest, enough - 1.0));
  EXPECT_FALSE(is_material(0.5 * limits.interest, enough + 1.0));
}

}  // namespace
}  // namespace flexspline::studies
