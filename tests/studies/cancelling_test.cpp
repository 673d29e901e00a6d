// Two corrections of a free rig's motor equation that take each other back: all of its torque turns
// inertias, so that an error of one of them is nearly a share of the motor's torque.
#include "diagnosis/model/cancelling.hpp"

#include <cmath>
#include <stdexcept>
#include <string_view>

#include <gmock/gmock.h>

#include "diagnosis/names/confirm.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

ActiveCause cause_named(std::string_view id, const Frame& frame, Equation first = Equation::motor) {
  for (const CauseRow& row : causes()) {
    if (row.id != id) continue;
    for (const CauseForm* form : forms_on(row, frame)) {
      if (first_equation(frame, *form) == first) return {&row, form, {}};
    }
  }
  throw std::logic_error("no such cause in this equation");
}

class CancellingPair : public testing::Test {
 protected:
  /// The pair with these coefficients beside the baseline.
  std::vector<Cancelling> found(double inertia, double share) {
    DriveModel model = baseline_.fit.model;
    model.causes = {inertia_, share_};
    model.coefficients = {Eigen::VectorXd::Constant(1, inertia),
                          Eigen::VectorXd::Constant(1, share)};
    return cancelling(frame_, model, baseline_.reference, 0.5);
  }
  ArrayXd column(const ActiveCause& cause) const {
    return frame_.usable *
           cause.form->columns(Equation::motor, frame_, baseline_.reference, cause.shape).front();
  }

  const Frame frame_ = drawn_frame(Rig::free);
  const Findings baseline_ = *fit_baseline(frame_);
  const ActiveCause inertia_ = cause_named("inertia_torque", frame_);
  const ActiveCause share_ = cause_named("torque_constant_error", frame_);
};

TEST_F(CancellingPair, IsWhoseSumIsLessThanHalfOfTheSmaller) {
  const ArrayXd x = column(inertia_), y = column(share_);
  const double opposite = -(x * y).sum() / y.square().sum();  // what takes x back best
  const double left = std::sqrt((x + opposite * y).square().sum() /
                                std::min(x.square().sum(), (opposite * y).square().sum()));
  ASSERT_LT(left, 0.5) << "the rig has to be one on which they are alike";
  const auto pairs = found(1.0, opposite);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].equation, Equation::motor);
  EXPECT_TRUE(pairs[0].has(0) && pairs[0].has(1));
  EXPECT_NEAR(pairs[0].left, left, 1e-6);
}

TEST_F(CancellingPair, IsNoneWhereTheyAddOrOneIsMuchLarger) {
  const ArrayXd x = column(inertia_), y = column(share_);
  const double opposite = -(x * y).sum() / y.square().sum();
  EXPECT_TRUE(found(1.0, -opposite).empty());
  EXPECT_TRUE(found(1.0, 0.4 * opposite).empty()) << "more than all of the smaller one is left";
}

Accepted accepted_with(const ActiveCause& cause, double gain) {
  Accepted accepted;
  accepted.trial.cause = cause;
  accepted.trial.gain = accepted.first_gain = gain;
  return accepted;
}

// Whatever recordings held out say of it: it goes before they are asked.
TEST_F(CancellingPair, LosesTheNameThatIsWorthLess) {
  const ArrayXd x = column(inertia_), y = column(share_);
  Selection s;
  s.baseline = s.final = baseline_;
  DriveModel& model = s.final.fit.model;
  model.causes = {inertia_, share_};
  model.coefficients = {Eigen::VectorXd::Constant(1, 1.0),
                        Eigen::VectorXd::Constant(1, -(x * y).sum() / y.square().sum())};
  s.accepted = {accepted_with(inertia_, 500.0), accepted_with(share_, 400.0)};
  const auto proof = confirm(frame_, {}, s);
  ASSERT_TRUE(proof) << proof.error().message();
  ASSERT_FALSE(s.withdrawn.empty());
  const Accepted& first_to_go = s.withdrawn.back();
  EXPECT_EQ(first_to_go.trial.cause.row, share_.row);
  EXPECT_THAT(std::string(first_to_go.withdrawn_because), testing::HasSubstr("takes most of it"));
}

/// An offset of the torque sensor, which the motor equation has to show as well, and one of the
/// motor's torque that takes a share of it back there.
Selection with_offsets(const Frame& frame, double share) {
  const ActiveCause sensor = cause_named("torque_sensor_offset", frame, Equation::torsion);
  const ActiveCause motor = cause_named("motor_torque_offset", frame);
  Selection s;
  s.baseline = s.final = *fit_baseline(frame);
  const auto in_motor_equation = [&](const ActiveCause& cause) {
    return cause.form->columns(Equation::motor, frame, s.final.reference, cause.shape)
        .front()
        .mean();
  };
  const double taken = -share * in_motor_equation(sensor) / in_motor_equation(motor);
  s.final.fit.model.causes = {sensor, motor};
  s.final.fit.model.coefficients = {Eigen::VectorXd::Constant(1, 1.0),
                                    Eigen::VectorXd::Constant(1, taken)};
  s.accepted = {accepted_with(sensor, 500.0), accepted_with(motor, 400.0)};
  return s;
}

std::string why_first_to_go(const Selection& s) {
  return s.withdrawn.empty() ? "none" : std::string(s.withdrawn.back().withdrawn_because);
}

TEST(TakenBack, InOneOfItsEquationsACauseIsRefuted) {
  const Frame frame = drawn_frame(Rig::locked);
  Selection s = with_offsets(frame, 0.95);
  const auto proof = confirm(frame, {}, s);
  ASSERT_TRUE(proof) << proof.error().message();
  ASSERT_FALSE(s.withdrawn.empty());
  EXPECT_EQ(s.withdrawn.back().trial.cause.row->id, "torque_sensor_offset");
  EXPECT_THAT(why_first_to_go(s), testing::HasSubstr("in one equation another takes back"));
}

TEST(TakenBack, InPartACauseIsTold) {
  const Frame frame = drawn_frame(Rig::locked);
  Selection s = with_offsets(frame, 0.85);
  ASSERT_TRUE(confirm(frame, {}, s));
  EXPECT_THAT(why_first_to_go(s), testing::Not(testing::HasSubstr("takes back")));
}

TEST_F(CancellingPair, IsToldInWords) {
  DriveModel model;
  model.causes = {inertia_, share_};
  const std::string says = in_words(model, {0, 1, Equation::motor, 0.25});
  for (const char* part : {"inertia_torque", "torque_constant_error", "motor equation", "25 %"}) {
    EXPECT_THAT(says, testing::HasSubstr(part));
  }
}

}  // namespace
}  // namespace flexspline::studies
