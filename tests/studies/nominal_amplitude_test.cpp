// The recorded motion against the amplitude that a set states.
#include <algorithm>
#include <optional>
#include <string_view>

#include <gtest/gtest.h>

#include "drive_frame.hpp"
#include "flexspline/data/sanity.hpp"
#include "flexspline/data/sanity_check.hpp"

namespace flexspline::studies {
namespace {

std::optional<data::Severity> severity_of(const RecordingSet& set, std::string_view check) {
  for (const data::SanityFinding& one : data::sanity_of(set)) {
    if (one.check == check) return one.severity;
  }
  return std::nullopt;
}

// What moves about another place is stated by its range or by where it comes to, and is as far off
// as the nearer of them.
TEST(NominalAmplitude, OfAMotionToOneSideMayBeWhereItComesTo) {
  RecordingSet set = drawn_case(Rig::specimen, 77).recordings;
  set.recordings.resize(1);
  Recording& r = set.recordings.front();
  auto& angle = r.channels.at(Quantity::torsion);
  const auto [least, most] = std::ranges::minmax(angle);
  const double half = 0.5 * (most - least);
  for (double& x : angle) x = 0.6 * (x - least) / half - 0.2;
  r.amplitude = 1.35;  // comes to 1, and moves by 0.6 to either side
  EXPECT_EQ(severity_of(set, "nominal_amplitude"), data::Severity::warning);
  r.amplitude = 0.65;
  EXPECT_EQ(severity_of(set, "nominal_amplitude"), std::nullopt);
  r.amplitude = 2.0;
  EXPECT_EQ(severity_of(set, "nominal_amplitude"), data::Severity::error);
}

}  // namespace
}  // namespace flexspline::studies
