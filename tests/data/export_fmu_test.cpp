// The FMU, taken apart and run as an importer does, against the C that it is made of and the
// standard's schema.
#include "claims/claims.hpp"
#include "export_fixture.hpp"
#include "source_dir.hpp"

namespace flexspline::data {
namespace {

using Instance = void*;

class Fmu : public testing::Test {
 protected:
  void SetUp() override {
    if (!there_is("unzip")) GTEST_SKIP() << "there is no unzip";
    write_export("fmu", model_, folder_);
    ASSERT_EQ(folder_.run("unzip -q drive.fmu"), 0);
  }
  std::string description() const {
    return read_file(folder_.path() / "modelDescription.xml").value_or("");
  }
  /// The value of an attribute of the description's first element that has it.
  std::string attribute(const std::string& name) const {
    const std::string text = description();
    const auto from = text.find(name + "=\"") + name.size() + 2;
    return text.substr(from, text.find('"', from) - from);
  }

  RigModel model_ = example_model(Rig::free);
  ExportFolder folder_;
};

TEST_F(Fmu, HoldsWhatTheStandardAsksFor) {
  for (const char* file : {"modelDescription.xml", "sources/buildDescription.xml",
                           "sources/drive.c", "sources/drive.h", "sources/fmi3.c"}) {
    EXPECT_TRUE(exists(folder_.path() / file)) << file;
  }
  EXPECT_EQ(attribute("fmiVersion"), "3.0");
  EXPECT_EQ(attribute("modelIdentifier"), "drive");
  if (!there_is("xmllint")) return;
  EXPECT_EQ(folder_.run("xmllint --noout modelDescription.xml sources/buildDescription.xml"), 0);
}

// Every output is listed in the structure, every reference is unique, causalities are the
// standard's.
TEST_F(Fmu, DescribesEveryVariableOnce) {
  if (!there_is("xmllint")) GTEST_SKIP() << "there is no xmllint";
  const auto counted = [&](const std::string& xpath, int expected) {
    const std::string command =
        fmt::format("test \"$(xmllint --xpath '{}' modelDescription.xml)\" = {}", xpath, expected);
    EXPECT_EQ(folder_.run(command), 0) << xpath;
  };
  counted("count(//ModelVariables/Float64)", 9);
  counted("count(//Float64[@causality=\"input\" and @start])", 2);
  counted("count(//Float64[@causality=\"output\"])", 6);
  counted(
      "count(//ModelStructure/Output[@valueReference=//Float64[@causality=\"output\"]/"
      "@valueReference])",
      6);
  counted("count(//Float64[@valueReference=preceding-sibling::Float64/@valueReference])", 0);
  counted("count(//Float64[not(@unit=//UnitDefinitions/Unit/@name)])", 0);
}

TEST_F(Fmu, RunsInAnImporterAsTheCStepsDo) {
  const auto binary = folder_.path() / "binaries/x86_64-linux/drive.so";
  if (!exists(binary)) GTEST_SKIP() << "there is no C compiler for x86_64";
  void* library = dlopen(binary.c_str(), RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(library, nullptr) << dlerror();
  const auto instantiate =
      symbol_of<Instance(const char*, const char*, const char*, bool, bool, bool, bool, const void*,
                         std::size_t, void*, void*, void*)>(library, "fmi3InstantiateCoSimulation");
  const auto set =
      symbol_of<int(Instance, const std::uint32_t*, std::size_t, const double*, std::size_t)>(
          library, "fmi3SetFloat64");
  const auto get =
      symbol_of<int(Instance, const std::uint32_t*, std::size_t, double*, std::size_t)>(
          library, "fmi3GetFloat64");
  const auto enter = symbol_of<int(Instance, bool, double, double, bool, double)>(
      library, "fmi3EnterInitializationMode");
  const auto leave = symbol_of<int(Instance)>(library, "fmi3ExitInitializationMode");
  const auto step = symbol_of<int(Instance, double, double, bool, bool*, bool*, bool*, double*)>(
      library, "fmi3DoStep");
  const auto release = symbol_of<void(Instance)>(library, "fmi3FreeInstance");
  EXPECT_EQ(instantiate("d", "{another}", nullptr, false, false, false, false, nullptr, 0, nullptr,
                        nullptr, nullptr),
            nullptr);
  Instance fmu = instantiate("d", attribute("instantiationToken").c_str(), nullptr, false, false,
                             false, false, nullptr, 0, nullptr, nullptr, nullptr);
  ASSERT_NE(fmu, nullptr);
  EXPECT_EQ(enter(fmu, false, 0.0, 0.0, false, 0.0), 0);
  EXPECT_EQ(leave(fmu), 0);

  // Held torques: our own integration, started anew at each communication point.
  std::vector<double> y(4, 0.0);
  constexpr double kStep = 5e-3;
  for (int k = 0; k < 200; ++k) {
    const double torque = 0.5 * std::sin(6.0 * k * kStep) + 0.3;
    const std::uint32_t input = 1;
    ASSERT_EQ(set(fmu, &input, 1, &torque, 1), 0);
    bool event = false;
    bool terminate = false;
    bool early = false;
    double reached = 0.0;
    ASSERT_EQ(step(fmu, k * kStep, kStep, true, &event, &terminate, &early, &reached), 0);
    EXPECT_DOUBLE_EQ(reached, k * kStep + kStep);
    RigInputs inputs;
    inputs.channels[Quantity::motor_torque] = constant(torque);
    const auto system = made_rig(model_, inputs, "motor_driven");
    y = later(*system, 0.0, kStep, y, 1e-11);
  }
  const std::uint32_t outputs[] = {3, 4, 5, 6};
  double values[4];
  ASSERT_EQ(get(fmu, outputs, 4, values, 4), 0);
  release(fmu);
  dlclose(library);
  EXPECT_GT(std::abs(y[0]), 1.0) << "it moves";
  constexpr double kDifference = 1e-6;
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(values[i], y[static_cast<std::size_t>(i)],
                kDifference * std::max(1.0, std::abs(y[static_cast<std::size_t>(i)])));
  }
  claims::expect("docs/export.md", "fmu", {{"difference", kDifference}});
}

}  // namespace
}  // namespace flexspline::data
