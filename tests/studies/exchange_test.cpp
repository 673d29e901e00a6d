// A cause that was accepted while another was still missing, against its alternative at the end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "active_cause.hpp"
#include "diagnosis/search/exchange.hpp"
#include "stribeck_frame.hpp"

namespace flexspline::studies {
namespace {

constexpr double kOffset = 0.03;  // Nm

Trial on_top(const Frame& frame, const Findings& findings, const char* id) {
  const auto [row, form] = form_named(frame, id);
  return try_cause(frame, findings, active(frame, *row, *form));
}

/// A cause with the other as its alternative, and a Stribeck friction accepted after it.
Selection searched(const Frame& frame, const char* first, const char* alternative) {
  Selection s;
  s.final = *fit_baseline(frame);
  Accepted one;
  one.trial = on_top(frame, s.final, first);
  one.rivals = {on_top(frame, s.final, alternative)};
  s.final.fit = one.trial.fit;
  s.accepted.push_back(std::move(one));
  EXPECT_TRUE(refresh(frame, s.final, 8));
  Accepted two;
  two.trial = on_top(frame, s.final, "stribeck_friction");
  s.final.fit = two.trial.fit;
  s.accepted.push_back(std::move(two));
  EXPECT_TRUE(refresh(frame, s.final, 8));
  return s;
}

std::vector<std::string> accepted_in(const Selection& s) {
  std::vector<std::string> ids;
  for (const Accepted& a : s.accepted) ids.emplace_back(a.trial.cause.row->id);
  return ids;
}

std::vector<std::string> in_model(const Selection& s) {
  std::vector<std::string> ids;
  for (const ActiveCause& cause : s.final.fit.model.causes) ids.emplace_back(cause.row->id);
  return ids;
}

Frame with_offset() {
  Frame frame = stribeck_frame();
  frame.motor_torque += kOffset;
  return frame;
}

Frame with_one_sided_friction() {
  Frame frame = stribeck_frame();
  frame.motor_torque += kOffset * stribeck_sign(frame).square();
  return frame;
}

TEST(Exchange, AnAlternativeThatExplainsMoreInTheEndTakesThePlace) {
  const Frame frame = with_offset();
  Selection s = searched(frame, "direction_asymmetry", "motor_torque_offset");
  ASSERT_TRUE(exchange_for_better(frame, {}, s));
  EXPECT_THAT(accepted_in(s), testing::ElementsAre("stribeck_friction", "motor_torque_offset"));
  EXPECT_EQ(in_model(s), accepted_in(s)) << "causes stand in the model in the order of the list";
  EXPECT_NEAR(s.final.fit.model.coefficients.back()[0], kOffset, 0.05 * kOffset);
}

TEST(Exchange, ACauseThatExplainsMoreStays) {
  const Frame frame = with_one_sided_friction();
  Selection s = searched(frame, "direction_asymmetry", "motor_torque_offset");
  const double before = chi_square(frame, s.final, s.final.fit);
  ASSERT_TRUE(exchange_for_better(frame, {}, s));
  EXPECT_THAT(accepted_in(s), testing::ElementsAre("direction_asymmetry", "stribeck_friction"));
  EXPECT_EQ(chi_square(frame, s.final, s.final.fit), before);
}

TEST(Exchange, OneCauseAloneHasBeenComparedAlready) {
  const Frame frame = with_offset();
  Selection s = searched(frame, "direction_asymmetry", "motor_torque_offset");
  s.accepted.pop_back();
  s.final.fit = s.accepted.front().trial.fit;
  ASSERT_TRUE(exchange_for_better(frame, {}, s));
  EXPECT_THAT(accepted_in(s), testing::ElementsAre("direction_asymmetry"));
}

}  // namespace
}  // namespace flexspline::studies
