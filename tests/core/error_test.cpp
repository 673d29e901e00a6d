#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "flexspline/core/error.hpp"
#include "flexspline/core/estimate.hpp"
#include "flexspline/core/nearest_name.hpp"

namespace flexspline {
namespace {

TEST(Error, SaysPlacesOutermostFirstThenProblemThenRemedy) {
  Error error = failure(ErrorCode::numerics, "the step is 0", "loosen the tolerance").value();
  error = in_context(error, "recording sine-1");
  error = in_context(error, "case a=0.2 deg");
  EXPECT_EQ(error.message(),
            "case a=0.2 deg: recording sine-1: the step is 0; loosen the tolerance");
  EXPECT_EQ(error.code, ErrorCode::numerics);
}

TEST(Error, WithoutRemedyEndsWithTheProblem) {
  EXPECT_EQ(failure(ErrorCode::usage, "no command").value().message(), "no command");
}

TEST(Expects, StopsWithThePromiseThatWasBroken) {
  expects(true, "never shown");
  EXPECT_DEATH(expects(false, "lengths agree"), "defect.*lengths agree");
}

TEST(Termination, StartsAsNotRun) {
  EXPECT_EQ(name_of(Estimate{}.termination), "not_run");
  EXPECT_EQ(name_of(Termination::failed), "failed");
}

constexpr std::array<std::string_view, 4> kKnown = {"gear_ratio", "locked", "specimen", "free"};

TEST(NearestName, FindsWhatWasMeant) {
  EXPECT_EQ(nearest_name("gear_ration", kKnown), "gear_ratio");
  EXPECT_EQ(nearest_name("gaer_ratio", kKnown), "gear_ratio");
  EXPECT_EQ(nearest_name("LOCKED", kKnown), "locked");
  EXPECT_EQ(nearest_name("fre", kKnown), "free");
}

TEST(NearestName, IsSilentWhenNothingIsNear) {
  EXPECT_FALSE(nearest_name("firmware_gain", kKnown).has_value());
  EXPECT_FALSE(nearest_name("x", kKnown).has_value());
  EXPECT_FALSE(nearest_name("", kKnown).has_value());
  EXPECT_FALSE(nearest_name("locked", {}).has_value());
}

TEST(Suggestion, NamesTheNearestOrAll) {
  EXPECT_EQ(suggestion("lockd", kKnown), "did you mean 'locked'?");
  EXPECT_EQ(suggestion("zzz", kKnown), "known: gear_ratio, locked, specimen, free");
}

}  // namespace
}  // namespace flexspline
