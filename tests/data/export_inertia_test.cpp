// No body of zero mass is written: a rig without an inertia is refused, by the key that is missing.
#include <nlohmann/json.hpp>

#include "export_fixture.hpp"

namespace flexspline::data {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct Lacking {
  const char* form;
  Rig rig;
  double motor;  ///< J1, kg m2
  double load;   ///< J2
  std::vector<std::string> keys;
};

std::string refusal(const Lacking& one) {
  RigModel model = example_model(one.rig);
  model.drive.motor_inertia = one.motor;
  model.drive.load_inertia = one.load;
  const auto carried = (*find_exporter(one.form))->carry(model);
  return carried ? std::string() : carried.error().message();
}

TEST(ExportWithoutInertia, IsRefusedByTheKeyToState) {
  const std::vector<Lacking> cases = {
      {"mjcf", Rig::free, 0.0, 2.9, {"motor_inertia"}},
      {"mjcf", Rig::free, 7e-4, 0.0, {"load_inertia"}},
      {"mjcf", Rig::free, 0.0, 0.0, {"motor_inertia", "load_inertia"}},
      {"mjcf", Rig::locked, 0.0, 0.0, {"motor_inertia"}},
      {"mjcf", Rig::servo, 0.0, 0.0, {"motor_inertia", "load_inertia"}},
      {"urdf", Rig::free, 0.0, 0.0, {"motor_inertia", "load_inertia"}},
      {"sdf", Rig::servo, 0.0, 0.0, {"motor_inertia", "load_inertia"}}};
  for (const Lacking& one : cases) {
    const std::string says = refusal(one);
    for (const std::string& key : one.keys) EXPECT_THAT(says, HasSubstr(key)) << one.form;
    EXPECT_THAT(says, AllOf(HasSubstr("[rig]"), HasSubstr("kg m2"))) << one.form;
    if (one.keys.size() == 1 && one.keys.front() == "load_inertia") {
      EXPECT_THAT(says, Not(HasSubstr("motor_inertia")));
    }
  }
}

TEST(ExportWithoutInertia, IsTakenWhereMotorAndLoadTurnAsOneAndEitherHasOne) {
  EXPECT_EQ(refusal({"mjcf", Rig::servo, 7e-4, 0.0, {}}), "");
  EXPECT_EQ(refusal({"urdf", Rig::free, 0.0, 2.9, {}}), "");
  EXPECT_EQ(refusal({"mjcf", Rig::locked, 7e-4, 0.0, {}}), "");
}

}  // namespace
}  // namespace flexspline::data
