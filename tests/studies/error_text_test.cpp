#include <nlohmann/json.hpp>

#include "program_fixture.hpp"
#include "stored.hpp"

namespace flexspline::studies {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

class ErrorsInWords : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    if (IsSkipped()) return;
    ASSERT_EQ(simulate("set").code, 0);
  }
};

TEST_F(ErrorsInWords, FitSaysTheUnitAndOfWhatThePercentAre) {
  const Ended ended =
      run_program({"fit", path("set"), "--estimator", "midpoint_polynomial", "--out", path("fit")});
  ASSERT_EQ(ended.code, 0) << ended.said;
  EXPECT_THAT(ended.result, HasSubstr(" Nm, "));
  EXPECT_THAT(ended.result, HasSubstr("% of the recording's peak"));
  const auto estimate = nlohmann::json::parse(read_text(path("fit/estimate.json")));
  EXPECT_EQ(estimate.at("error_unit"), "Nm");
  EXPECT_GE(estimate.at("seconds").get<double>(), 0.0);
  for (const auto& note : estimate.at("notes")) {
    EXPECT_THAT(ended.result, HasSubstr("note: " + note.get<std::string>()));
  }
}

// A stiff model held at ten times its numbers cannot be anywhere near.
TEST_F(ErrorsInWords, WhatIsLargerThanTheSignalHasDiverged) {
  std::string model = read_text(path("model.toml"));
  model.replace(model.find("[10.0, 5.0]"), 11, "[100.0, 50.0]");
  folder_.write("stiff.toml", model);
  const Ended ended = run_program(
      {"fit", path("set"), "--model", path("stiff.toml"), "--hold", "f", "--out", path("fit")});
  ASSERT_EQ(ended.code, 0) << ended.said;
  EXPECT_THAT(ended.result, HasSubstr("diverged: larger than the signal"));
}

// Ten times faster than what was trained on: g^-1 is known nowhere near.
TEST_F(ErrorsInWords, WhatIsBeyondTheTrainingIsExtrapolated) {
  const std::string faster =
      "[[recording]]\nid = \"fast\"\nfile = \"fast.csv\"\nexcitation = \"sine\"\nsplit = "
      "\"holdout\"\n";
  ASSERT_EQ(run_program({"simulate", path("model.toml"), "--excitation", "sine", "--amplitude",
                         "0.2deg", "--frequency", "0.05Hz", "--extrapolate", "--out", path("fast")})
                .code,
            0);
  std::filesystem::path table;
  for (const auto& entry : std::filesystem::directory_iterator(path("fast"))) {
    if (entry.path().extension() == ".csv") table = entry.path();
  }
  folder_.write("set/fast.csv", read_text(table));
  folder_.write("set/dataset.toml", read_text(path("set/dataset.toml")) + faster);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"fit", path("set"), "--estimator", "static_regression"},
        std::vector<std::string>{"compare", path("set"), "--estimators", "static_regression"}}) {
    std::vector<std::string> call = words;
    call.insert(call.end(), {"--out", path(words.front())});
    const Ended ended = run_program(call);
    ASSERT_EQ(ended.code, 0) << ended.said;
    EXPECT_THAT(ended.result, HasSubstr("extrapolated, its motion or speed goes beyond"));
  }
}

TEST_F(ErrorsInWords, CompareSaysTheSameOfEveryEstimator) {
  const Ended ended = run_program({"compare", path("set"), "--estimators",
                                   "midpoint_polynomial,trajectory_ceres", "--out", path("both")});
  ASSERT_EQ(ended.code, 0) << ended.said;
  EXPECT_THAT(ended.result, HasSubstr("Nm, "));
  for (const char* id : {"midpoint_polynomial", "trajectory_ceres"}) {
    const auto artefact = stored_artefact(path("both"), "set--" + std::string(id) + "--r0");
    for (const auto& note : artefact.at("estimate").at("notes")) {
      EXPECT_THAT(ended.result, HasSubstr("note: " + note.get<std::string>()));
    }
  }
}

}  // namespace
}  // namespace flexspline::studies
