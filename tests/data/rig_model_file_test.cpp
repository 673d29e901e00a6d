// The table [rig] of a model file.
#include "export_fixture.hpp"
#include "flexspline/data/model_toml.hpp"

namespace flexspline::data {
namespace {

TEST(RigModelFile, ReadsBackToTheLastBit) {
  for (Rig rig : {Rig::free, Rig::locked, Rig::servo}) {
    RigModel model = example_model(rig);
    model.drive.motor_inertia = 1.0 / 3.0;
    model.drive.torsion.effects = {
        {"stribeck_friction",
         {{"excess", 0.1}, {"stribeck_speed", 3.0}, {"exponent", 2.0}, {"smoothing", 0.1}},
         "too small to be named",
         true}};
    model.origin = {{"gear_ratio", Origin::given},
                    {"f", Origin::fitted},
                    {"h", Origin::assumed},
                    {"motor_viscous", Origin::not_identifiable}};
    const auto back = parse_rig_model(model_toml(model), "model.toml");
    ASSERT_TRUE(back) << back.error().message();
    EXPECT_EQ(back->rig, rig);
    EXPECT_EQ(back->drive.gear_ratio, model.drive.gear_ratio);
    for (const DriveConstant& one : rig_row(rig).constants) {
      EXPECT_EQ(back->drive.*one.member, model.drive.*one.member) << one.name;
    }
    const EffectSpec& effect = back->drive.torsion.effects.front();
    EXPECT_EQ(effect.note, "too small to be named");
    EXPECT_TRUE(effect.across);
    EXPECT_EQ(back->origin, model.origin);
    EXPECT_TRUE(back->drive.torsion.f == model.drive.torsion.f);
  }
}

TEST(RigModelFile, RefusesWhatTheRigDoesNotHave) {
  const std::string laws =
      "[f]\nlaw = \"odd_polynomial\"\nscale = 1.0\ncoefficients = [1.0]\n"
      "[g_inverse]\nlaw = \"odd_polynomial\"\nscale = 1.0\ncoefficients = [1.0]\n";
  const auto refusal = [&](const std::string& rig) {
    const auto model =
        parse_rig_model("schema = \"flexspline-model/1\"\n[rig]\n" + rig + laws, "m.toml");
    return model ? std::string() : model.error().message();
  };
  using testing::HasSubstr;
  EXPECT_EQ(refusal("rig = \"free\"\ngear_ratio = 50\n"), "");
  EXPECT_THAT(refusal("rig = \"fre\"\n"), HasSubstr("unknown rig 'fre'"));
  EXPECT_THAT(refusal("rig = \"locked\"\nload_inertia = 1.0\n"), HasSubstr("load_inertia"));
  EXPECT_THAT(refusal("rig = \"free\"\n[origin]\nh = \"guessed\"\n"),
              HasSubstr("unknown origin 'guessed'"));
  EXPECT_THAT(refusal("rig = \"locked\"\n[origin]\nload_inertia = \"given\"\n"),
              HasSubstr("load_inertia"));
  EXPECT_THAT(refusal("rig = \"free\"\nload_inertia = -1.0\n"), HasSubstr("load_inertia is -1"));
}

}  // namespace
}  // namespace flexspline::data
