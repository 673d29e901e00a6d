// Robot descriptions and lookup tables against the drive that they are made of.
#include <sstream>

#include "export_fixture.hpp"
#include "flexspline/core/law.hpp"

namespace flexspline::data {
namespace {

/// What xmllint finds at an XPath of a file in the folder.
double number_at(const ExportFolder& folder, const std::string& file, const std::string& xpath) {
  EXPECT_EQ(folder.run(fmt::format("xmllint --xpath 'number({})' {} > found", xpath, file)), 0);
  return std::stod(read_file(folder.path() / "found").value_or("nan"));
}

struct Described {
  const char* exporter;
  const char* file;
  const char* damping;
  const char* friction;
  const char* mass;
  const char* inertia;
};

constexpr Described kForms[] = {
    {"urdf", "drive.urdf", "//dynamics/@damping", "//dynamics/@friction", "//mass/@value",
     "//inertia/@iyy"},
    {"sdf", "drive.sdf", "//dynamics/damping", "//dynamics/friction", "//mass", "//iyy"},
};

class RobotDescription : public testing::TestWithParam<Described> {};

// The rigid limit of eqs. (5) to (8): (J2 + N^2 J1) q'' + (B2 + N^2 B1) q' + N C1 sign q' = N
// tau_m.
TEST_P(RobotDescription, IsTheRigidLimitOfTheRig) {
  if (!there_is("xmllint")) GTEST_SKIP() << "there is no xmllint";
  const Described& form = GetParam();
  const RigModel model = example_model(Rig::free);
  const DriveSpec& d = model.drive;
  const ExportFolder folder;
  write_export(form.exporter, carried(form.exporter, model).model, folder);
  const double n2 = d.gear_ratio * d.gear_ratio;
  EXPECT_NEAR(number_at(folder, form.file, form.damping), n2 * d.motor_viscous + d.load_viscous,
              1e-12);
  EXPECT_NEAR(number_at(folder, form.file, form.friction), d.gear_ratio * d.motor_coulomb, 1e-12);
  const double mass = number_at(folder, form.file, form.mass);
  EXPECT_NEAR(mass, d.load_mass, 1e-12);
  EXPECT_NEAR(number_at(folder, form.file, form.inertia) + mass * d.arm_length * d.arm_length,
              d.load_inertia + n2 * d.motor_inertia, 1e-9);
}

TEST_P(RobotDescription, SaysThatTheComplianceIsLost) {
  const Carried result = carried(GetParam().exporter, example_model(Rig::free));
  const bool said = std::ranges::any_of(result.lost, [](const auto& one) {
    return one.what.find("compliance") != std::string::npos;
  });
  EXPECT_TRUE(said);
}

INSTANTIATE_TEST_SUITE_P(Forms, RobotDescription, testing::ValuesIn(kForms),
                         [](const auto& info) { return std::string(info.param.exporter); });

/// Rows of a table that `comment` lines and one line of names stand before.
std::vector<std::pair<double, double>> rows_of(const std::string& text) {
  std::vector<std::pair<double, double>> rows;
  std::istringstream stream(text);
  bool named = false;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("#")) continue;
    if (named) rows.emplace_back(std::stod(line), std::stod(line.substr(line.find(',') + 1)));
    named = true;
  }
  return rows;
}

// Linear between its points, a table of f follows the law to the curvature over one interval.
TEST(LookupTable, FollowsTheLawsBetweenItsPoints) {
  const RigModel model = example_model(Rig::free);
  const ExportFolder folder;
  write_export("table", carried("table", model).model, folder);
  for (const auto& [file, spec] :
       {std::pair{"drive_f.csv", model.drive.torsion.f},
        std::pair{"drive_g_inverse.csv", model.drive.torsion.g_inverse}}) {
    const auto rows = rows_of(read_file(folder.path() / file).value_or(""));
    ASSERT_GT(rows.size(), 100u) << file;
    const auto law = make_law(spec);
    ASSERT_TRUE(law);
    const double largest = std::abs(rows.back().second);
    for (std::size_t i = 1; i < rows.size(); ++i) {
      EXPECT_LT(rows[i - 1].first, rows[i].first);
      const double middle = 0.5 * (rows[i - 1].first + rows[i].first);
      const double between = 0.5 * (rows[i - 1].second + rows[i].second);
      EXPECT_NEAR(between, (*law)->value(middle), 1e-4 * largest) << file << " at " << middle;
    }
  }
}

TEST(LookupTable, OctaveReadsTheSameNumbers) {
  if (!there_is("octave-cli")) GTEST_SKIP() << "there is no octave-cli";
  const RigModel model = example_model(Rig::free);
  const ExportFolder folder;
  write_export("table", carried("table", model).model, folder);
  ASSERT_EQ(
      folder.run("octave-cli --quiet --eval \"m = drive(); "
                 "printf('%.17g %.17g', interp1(m.f.x, m.f.y, 1e-3), m.gear_ratio)\" > found"),
      0);
  double torque = 0.0, ratio = 0.0;
  std::istringstream(read_file(folder.path() / "found").value_or("")) >> torque >> ratio;
  const double exact = (*make_law(model.drive.torsion.f))->value(1e-3);
  EXPECT_NEAR(torque, exact, 1e-4 * exact);
  EXPECT_EQ(ratio, model.drive.gear_ratio);
}

}  // namespace
}  // namespace flexspline::data
