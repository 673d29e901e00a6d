// Diagnoses of free drives whose torque no sensor measures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis_checks.hpp"
#include "drive_frame.hpp"
#include "without_sensor.hpp"

namespace flexspline::studies {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Diagnosis diagnosed_without(std::uint64_t seed, std::vector<data::HiddenEffect> effects) {
  return diagnosed(without_sensor(drawn_case(Rig::free, seed, std::move(effects)).recordings));
}

// More than noise may be left: the load's acceleration is known to no better than its encoder.
TEST(WithoutTorqueSensor, NothingMissingIsNeverNamed) {
  for (const std::uint64_t seed : {11U, 13U, 14U}) {
    const Diagnosis d = diagnosed_without(seed, {});
    EXPECT_THAT(names(d), ElementsAre()) << seed << ": " << d.says;
    EXPECT_THAT(d.baseline_model, HasSubstr("no sensor measures, by load inertia and drag"));
  }
}

class NamedWithoutTorqueSensor : public testing::TestWithParam<const char*> {};

TEST_P(NamedWithoutTorqueSensor, KeepsItsName) {
  const Diagnosis d = diagnosed_without(12, {{GetParam(), 0.06}});
  EXPECT_THAT(names(d), ElementsAre(GetParam())) << d.says;
}

// At the load, across the gear, at the motor, in an angle.
INSTANTIATE_TEST_SUITE_P(Sites, NamedWithoutTorqueSensor,
                         testing::Values("gravity_load", "presliding_hysteresis",
                                         "load_dependent_friction", "kinematic_error"),
                         [](const auto& id) { return std::string(id.param); });

}  // namespace
}  // namespace flexspline::studies
