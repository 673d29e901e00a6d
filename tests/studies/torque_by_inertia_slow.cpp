// Diagnoses of free drives whose torque no sensor measures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis_checks.hpp"
#include "drive_frame.hpp"
#include "without_sensor.hpp"

namespace flexspline::studies {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

Diagnosis diagnosed_without(std::uint64_t seed, std::vector<data::HiddenEffect> effects) {
  return diagnosed(without_sensor(drawn_case(Rig::free, seed, std::move(effects)).recordings));
}

TEST(WithoutTorqueSensor, NothingMissingIsAdequate) {
  const Diagnosis d = diagnosed_without(11, {});
  EXPECT_THAT(names(d), ElementsAre());
  EXPECT_EQ(d.verdict, Verdict::adequate) << d.says;
  EXPECT_THAT(d.baseline_model, HasSubstr("load inertia and drag"));
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
