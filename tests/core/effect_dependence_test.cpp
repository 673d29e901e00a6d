#include "flexspline/core/effect_dependence.hpp"

#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "flexspline/core/simulate.hpp"

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

TEST(SimulateTorque, RefusesATorsionThatFollowsTheTorque) {
  const EffectRow& row = **find_effect("series_compliance");
  EffectSpec spec{.effect = "series_compliance", .parameters = {}};
  for (const auto& one : row.parameters) spec.parameters.emplace_back(one.name, one.nominal);
  const LawSpec line{.law = "odd_polynomial", .scale = 1.0, .knots = {}, .coefficients = {5000.0}};
  const ModelSpec model{.f = line,
                        .g_inverse = line,
                        .h = {.law = "bounded_modulation", .knots = {}, .coefficients = {}},
                        .effects = {spec}};
  const Motion motion{.time = {0.0, 1.0, 2.0},
                      .position = {0.0, 1e-3, 0.0},
                      .velocity = {0.0, 0.0, 0.0},
                      .acceleration = {0.0, 0.0, 0.0}};
  const auto torque = simulate_torque(model, motion);
  ASSERT_FALSE(torque);
  EXPECT_NE(torque.error().message().find("series_compliance"), std::string::npos);
}

}  // namespace
}  // namespace flexspline
