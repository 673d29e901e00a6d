// A profile of a simulated torsion integrates the gear some thousand times.
#include "torsion_intervals.hpp"

namespace flexspline::estimators {
namespace {

TEST(TorsionIntervals, ByProfileOfASimulatedTorsion) {
  const auto plain = with_intervals("covariance", "torsion", 20);
  const auto profile = with_intervals("profile", "torsion", 20);
  ASSERT_EQ(plain.parameters.size(), profile.parameters.size());
  int near = 0;
  for (std::size_t k = 0; k < plain.parameters.size(); ++k) {
    if (is_free(plain.parameters[k])) {
      near += std::abs(width(profile.parameters[k]) / width(plain.parameters[k]) - 1.0) < 0.2;
    }
  }
  EXPECT_GE(near, 4);
}

}  // namespace
}  // namespace flexspline::estimators
