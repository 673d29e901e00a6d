// A slice of flexspline_band_coverage (docs/fits.md): the 95 % bands on gears of no estimator's
// class.
#include <gtest/gtest.h>

#include "band_coverage.hpp"

namespace flexspline::estimators {
namespace {

// Two sets a family and colour of noise, of 16 and 4. The points of a set hang together, so that
// the share of a function has a standard deviation of some 1.5 points.
TEST(BandCoverage, OfGearsOfNoEstimatorsClass) {
  const auto tallies =
      band_coverage(kGearFamilies, 2, 5001, 2, {.numbers = {}, .words = {{"simulate", "torque"}}});
  CoverageTally all;
  for (const auto& family : tallies) {
    for (const auto& colour : family) all.add(colour);
  }
  EXPECT_EQ(all.failed, 0);
  for (const auto& [name, tally] :
       {std::pair{"f", all.f}, {"g_inverse", all.g_inverse}, {"h", all.h}}) {
    std::printf("%s: %.4f of %d\n", name, share(tally), tally.asked);
    EXPECT_GE(share(tally), 0.90) << name;
    EXPECT_LE(share(tally), 0.99) << name;
  }
  EXPECT_LE(all.overconfident, all.sets / 20);
  EXPECT_GT(all.identifiable, all.sets / 4);
}

// Nothing of a joint that travels counts as a repeat: noise comes from what is left.
TEST(BandCoverage, OfJointsThatTravel) {
  const auto tallies =
      band_coverage(std::span(kGearFamilies).first(kFamiliesOfTorque), 1, 6101, 2,
                    {.numbers = {}, .words = {{"simulate", "torque"}}}, CoverageMotion::travels);
  CoverageTally all;
  for (const auto& family : tallies) {
    for (const auto& colour : family) all.add(colour);
  }
  EXPECT_EQ(all.failed, 0);
  EXPECT_EQ(all.printed, 0);  // no h
  for (const auto& [name, tally] : {std::pair{"f", all.f}, {"g_inverse", all.g_inverse}}) {
    std::printf("%s: %.4f of %d\n", name, share(tally), tally.asked);
    EXPECT_GE(share(tally), 0.90) << name;
    EXPECT_LE(share(tally), 0.995) << name;
  }
}

// Where f has its kink on the gauge point, f(0) = 0, a kink that is smoothed moves f everywhere:
// with knots no denser there the same sets have 78 %.
TEST(BandCoverage, OfAKinkOnTheGaugePoint) {
  const auto family =
      std::ranges::find(kGearFamilies, std::string_view("f with |x|"), &GearFamily::name);
  const auto tallies =
      band_coverage({&*family, 1}, 4, 401, 2, {.numbers = {}, .words = {{"simulate", "torque"}}});
  CoverageTally all;
  for (const auto& colour : tallies.front()) all.add(colour);
  EXPECT_EQ(all.failed, 0);
  EXPECT_GE(share(all.f), 0.90);
  EXPECT_GE(share(all.g_inverse), 0.90);
  EXPECT_GE(share(all.h), 0.90);
}

}  // namespace
}  // namespace flexspline::estimators
