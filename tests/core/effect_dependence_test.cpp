#include "flexspline/core/effect_dependence.hpp"

#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace flexspline {
namespace {

std::vector<double> nominal(const EffectRow& row) {
  std::vector<double> values;
  for (const auto& one : row.parameters) values.push_back(one.nominal);
  return values;
}

bool depends(std::string_view id, Complex Instant<Complex>::*variable) {
  const EffectRow& row = **find_effect(id);
  return depends_on(row, nominal(row), variable);
}

TEST(DependsOn, SeesWhatATermReads) {
  EXPECT_TRUE(depends("inertia_torque", &Instant<Complex>::torsion_acceleration));
  EXPECT_FALSE(depends("inertia_torque", &Instant<Complex>::torsion_rate));
  EXPECT_TRUE(depends("series_compliance", &Instant<Complex>::transmitted_torque));
}

TEST(DependsOn, SeesWhatOnlyTheMemoryReads) {
  EXPECT_TRUE(depends("current_lag", &Instant<Complex>::motor_torque_rate));
  EXPECT_FALSE(depends("torque_sensor_offset", &Instant<Complex>::motor_torque_rate));
}

}  // namespace
}  // namespace flexspline
