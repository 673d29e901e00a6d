// How often 95 % bands of f, g^-1 and h within the fitted class hold a truth of it, over seeded
// replicates of one experiment.
#include <gtest/gtest.h>

#include "gears.hpp"

namespace flexspline::estimators {
namespace {

constexpr unsigned kReplicates = 250;

struct Tally {
  int held = 0;
  int asked = 0;
};

// Counts at points of one side of a band, in shares of the range of the recordings.
void count(const FunctionBand& band, const std::function<double(double)>& truth, double range,
           Tally& tally, std::initializer_list<double> points = {0.15, 0.35, 0.55, 0.75, 0.95}) {
  for (double u : points) {
    std::size_t nearest = 0;
    for (std::size_t k = 0; k < band.argument.size(); ++k) {
      if (std::abs(band.argument[k] - u * range) < std::abs(band.argument[nearest] - u * range)) {
        nearest = k;
      }
    }
    const double y = truth(band.argument[nearest]);
    tally.held += band.lower[nearest] <= y && y <= band.upper[nearest] ? 1 : 0;
    ++tally.asked;
  }
}

// Of 250 independent intervals at 95 %, 91.2 to 98.4 % hold in 99 of 100 studies (binomial); the
// points of a replicate are not independent.
// Below 0.1 of the range g^-1 is counted on its own: there noise puts its first slope on the floor
// that keeps it increasing, and a band that counted that slope as known would be too narrow.
TEST(Coverage, OfTheBandsOfFAndGAndH) {
  const auto gear = gear_with_even_h();
  for (std::string simulate : {"torsion", "torque"}) {
    Tally f;
    Tally g;
    Tally slow;
    Tally h;
    for (unsigned replicate = 1; replicate <= kReplicates; ++replicate) {
      const auto estimate =
          fitted("trajectory_ceres",
                 four_loops(gear, {.per_cycle = 150, .noise = 0.005, .seed = 1000 + replicate}),
                 {.words = {{"simulate", simulate}, {"bands", "class"}}});
      ASSERT_TRUE(estimate) << estimate.error().message();
      for (const auto& band : estimate->bands) {
        if (band.function == "f") count(band, gear.f, kAmplitude, f);
        if (band.function == "g_inverse") {
          count(band, gear.g_inverse, kSpeed, g);
          count(band, gear.g_inverse, kSpeed, slow, {0.03, 0.05, 0.08});
        }
        if (band.function == "h") count(band, gear.h, kAmplitude, h);
      }
    }
    for (const auto& [name, tally] :
         {std::pair{"f", f}, {"g_inverse", g}, {"g_inverse_slow", slow}, {"h", h}}) {
      const double share = static_cast<double>(tally.held) / tally.asked;
      std::printf("%s by %s: %.4f of %d\n", name, simulate.c_str(), share, tally.asked);
      EXPECT_GE(share, 0.912) << name << " by " << simulate;
      EXPECT_LE(share, 0.984) << name << " by " << simulate;
    }
  }
}

}  // namespace
}  // namespace flexspline::estimators
