// What a diagnosis tells of a fixture that rings, and of what a mode follows without being one.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drive_frame.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

Diagnosis diagnosed_case(const char* effect) {
  const auto hidden = drawn_case(Rig::specimen, 11, {{effect, 0.06}});
  const auto diagnosis = diagnose(hidden.recordings, {}, {.nested = false});
  EXPECT_TRUE(diagnosis) << (diagnosis ? "" : diagnosis.error().message());
  return diagnosis ? *diagnosis : Diagnosis{};
}

// 3.335 Hz and 0.0541 of the critical damping are hidden.
TEST(ToldResonance, IsThatOfAFixture) {
  const Diagnosis d = diagnosed_case("unknown:fixture_resonance");
  EXPECT_EQ(d.verdict, Verdict::unexplained);
  EXPECT_TRUE(d.causes.empty());
  ASSERT_FALSE(d.mismatch.empty());
  EXPECT_EQ(d.mismatch.front().coordinate, "lag");
  EXPECT_THAT(d.mismatch.front().says, HasSubstr("rings (frequency 3.34 Hz, damping 0.05"));
  EXPECT_THAT(d.says, HasSubstr("that rings"));
  EXPECT_LT(d.holdout.over_noise(), 1.05);
}

// A mode answers a motion that comes again nearly as such a product does; a table follows it better
// and says what it is.
TEST(ToldResonance, IsNoneOfAProductOfPositionAndSpeed) {
  const Diagnosis d = diagnosed_case("unknown:cross");
  EXPECT_EQ(d.verdict, Verdict::unexplained);
  ASSERT_TRUE(d.unnamed);
  EXPECT_THAT(d.says, Not(AnyOf(HasSubstr("resonance"), HasSubstr("rings"))));
  for (const Mismatch& one : d.mismatch) {
    EXPECT_THAT(one.says, Not(AnyOf(HasSubstr("resonance"), HasSubstr("rings"))));
  }
  EXPECT_THAT(d.unnamed->proposed_equation, HasSubstr("w phi"));
}

}  // namespace
}  // namespace flexspline::studies
