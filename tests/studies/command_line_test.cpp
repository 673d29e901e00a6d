#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "command_line.hpp"
#include "source_dir.hpp"

namespace flexspline::studies {
namespace {

using testing::HasSubstr;

const std::string kStudy = kHead +
                           "[bench]\nangle_noise = { value = 0.1, unit = \"%\" }\n"
                           "torque_noise_white = { value = 0.1, unit = \"%\" }\n"
                           "cycles = 3\nsamples_per_cycle = 200\n" +
                           kGrid + kInput + kEstimator;

TEST_F(CommandLine, VersionNamesCommitCompilerAndLibraries) {
  const Finished done = call("--version");
  EXPECT_EQ(done.code, 0);
  for (const char* name : {"commit", "compiler", "Ipopt", "Ceres", "SUNDIALS", "Eigen"}) {
    EXPECT_THAT(done.result, HasSubstr(name));
  }
}

TEST_F(CommandLine, UsageErrorsExitWith2) {
  EXPECT_EQ(call("").code, 2);
  EXPECT_EQ(call("run").code, 2);
  EXPECT_EQ(call("run a.toml --out x --frobnicate").code, 2);
  EXPECT_EQ(call("list nothing").code, 2);
  EXPECT_EQ(call("fit somewhere --out x").code, 2);
  EXPECT_EQ(call("fit somewhere --estimator bouc_wen --model m.toml --out x").code, 2);
  const Finished done = call("rnu a.toml");
  EXPECT_EQ(done.code, 2);
  EXPECT_THAT(done.output, HasSubstr("did you mean 'run'?"));
}

TEST_F(CommandLine, RunPrintsThePathOfAReportThatIsThere) {
  folder_.write("study.toml", kStudy);
  const Finished done = call("run " + path("study.toml") + " --out " + path("out"));
  EXPECT_EQ(done.code, 0) << done.output;
  EXPECT_THAT(done.result, HasSubstr(path("out")));
  EXPECT_TRUE(std::filesystem::exists(path("out/report/index.html")));
  EXPECT_EQ(call("report " + path("out")).code, 0);
}

TEST_F(CommandLine, RunSaysAsJsonThatNothingWasRedone) {
  folder_.write("study.toml", kStudy);
  const std::string line = "run " + path("study.toml") + " --json --quiet --out " + path("out");
  EXPECT_EQ(nlohmann::json::parse(call(line).result)["computed"], 1);
  const auto again = nlohmann::json::parse(call(line).result);
  EXPECT_EQ(again["computed"], 0);
  EXPECT_EQ(again["reused"], 1);
}

TEST_F(CommandLine, PlanWritesNothing) {
  folder_.write("study.toml", kStudy);
  const Finished done = call("plan --list " + path("study.toml"));
  EXPECT_EQ(done.code, 0);
  EXPECT_THAT(done.result, HasSubstr("1 cases, 1 different fits"));
  EXPECT_THAT(done.result, HasSubstr("unity--paper--r0"));
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

TEST_F(CommandLine, BadStudyExitsWith65AndSaysEverything) {
  folder_.write("study.toml", kHead + "sed = 1\n" + kGrid + kInput + kEstimator + "trian = 1\n");
  for (const char* command : {"validate ", "plan "}) {
    const Finished done = call(command + path("study.toml"));
    EXPECT_EQ(done.code, 65);
    EXPECT_THAT(done.output, HasSubstr("study.toml:3:1"));
    EXPECT_THAT(done.output, HasSubstr("did you mean 'train'?"));
  }
  EXPECT_EQ(call("run " + path("study.toml") + " --out " + path("out")).code, 65);
  EXPECT_FALSE(std::filesystem::exists(path("out"))) << "nothing half-written";
}

TEST_F(CommandLine, MissingInputExitsWith66) {
  EXPECT_EQ(call("run " + path("none.toml") + " --out " + path("out")).code, 66);
  EXPECT_EQ(call("report " + path("none")).code, 66);
  EXPECT_EQ(
      call("fit " + path("none") + " --estimator midpoint_polynomial --out " + path("out")).code,
      66);
}

TEST_F(CommandLine, PathThatNoFileSystemHasExitsWith66AndIsNamed) {
  folder_.write("study.toml", kStudy);
  ASSERT_EQ(call("run " + path("study.toml") + " --out " + path("out")).code, 0);
  const Finished done = call("verify " + path("out") + " --out " + path("again") + " --against " +
                             std::string(5000, 'y'));
  EXPECT_EQ(done.code, 66);
  EXPECT_THAT(done.output, HasSubstr("yyyy': File name too long"));
}

TEST_F(CommandLine, FolderThatCannotBeWrittenExitsWith73AndIsNamed) {
  folder_.write("study.toml", kStudy);
  folder_.write("file", "");
  const Finished done = call("run " + path("study.toml") + " --out " + path("file/out"));
  EXPECT_EQ(done.code, 73);
  EXPECT_THAT(done.output, HasSubstr(path("file/out")));
}

TEST_F(CommandLine, ListsEveryCatalogue) {
  for (const char* name :
       {"effects", "laws", "rigs", "estimators", "kinds", "metrics", "truths", "commands"}) {
    const Finished done = call(std::string("list --json ") + name);
    EXPECT_EQ(done.code, 0) << name;
    EXPECT_FALSE(nlohmann::json::parse(done.result).empty()) << name;
  }
}

TEST_F(CommandLine, ListsTheFormsConstantsAndResidualsOfRigsInWords) {
  const Finished done = call("list rigs");
  ASSERT_EQ(done.code, 0);
  for (const char* words :
       {"form position_loop", "driven by commanded_angle", "loop_integral", "equations",
        "motor_inertia            kg m2", "residuals          motor, load, torsion, drive"}) {
    EXPECT_THAT(done.result, HasSubstr(words));
  }
}

TEST_F(CommandLine, SchemaIsJsonAndKnowsEveryKeyOfThePaperStudy) {
  const Finished done = call("schema study");
  ASSERT_EQ(done.code, 0);
  const auto schema = nlohmann::json::parse(done.result);
  EXPECT_TRUE(schema["properties"].contains("estimator"));
  EXPECT_EQ(call("schema studdy").code, 2);
}

TEST_F(CommandLine, SimulateWritesADataSetThatFits) {
  // f = 10 x + 5 x^3 and g^-1 = 3 z, see the file.
  folder_.write("model.toml",
                read_text(std::string(FLEXSPLINE_SOURCE_DIR) + "/tests/studies/cubic_model.toml"));
  const Finished done =
      call("simulate " + path("model.toml") +
           " --excitation sine --amplitude 0.2deg --frequency 0.005Hz --out " + path("set"));
  ASSERT_EQ(done.code, 0) << done.output;
  EXPECT_EQ(call("validate " + path("set")).code, 0);
  const Finished fit =
      call("fit " + path("set") + " --estimator midpoint_polynomial --json --out " + path("fit"));
  ASSERT_EQ(fit.code, 0) << fit.output;
  const auto estimate = nlohmann::json::parse(fit.result);
  EXPECT_LT(estimate["rmse"]["train"]["sine"].get<double>(), 1e-3 * 15.0);
  EXPECT_TRUE(std::filesystem::exists(path("fit/estimate.json")));
}

TEST_F(CommandLine, ConcealWritesADataSetThatIsValidWithTheAnswerBesideIt) {
  const std::string bench =
      "schema = \"flexspline-bench/1\"\nrig = \"locked\"\n"
      "effects = [{ id = \"backlash\", size_fraction = 0.05 }]\n"
      "[[excitation]]\nmotion = \"sine\"\namplitude = { value = 0.2, unit = \"deg\" }\n"
      "frequency = { value = 0.05, unit = \"Hz\" }\nsamples = 200\n";
  folder_.write("bench.toml", bench);
  const std::string line = "conceal " + path("bench.toml") + " --salt 0123456789 --out ";
  const Finished done = call(line + path("one"));
  ASSERT_EQ(done.code, 0) << done.output;
  EXPECT_EQ(done.result, path("one/dataset") + "\n");
  EXPECT_EQ(call("validate " + path("one/dataset")).code, 0);
  EXPECT_EQ(call("validate " + path("bench.toml")).code, 0);
  ASSERT_EQ(call(line + path("two")).code, 0);
  for (const char* file : {"commitment.json", "answer.sealed.json", "dataset/dataset.toml"}) {
    EXPECT_EQ(read_text(path("one") + "/" + file), read_text(path("two") + "/" + file)) << file;
  }
  ASSERT_EQ(call("conceal " + path("bench.toml") + " --out " + path("three")).code, 0);
  EXPECT_NE(read_text(path("one/commitment.json")), read_text(path("three/commitment.json")))
      << "a salt of its own";
  EXPECT_EQ(call("validate " + path("one/answer.sealed.json")).code, 0);
  folder_.write("one/commitment.json", read_text(path("three/commitment.json")));
  const Finished tampered = call("validate " + path("one/answer.sealed.json"));
  EXPECT_EQ(tampered.code, 65);
  EXPECT_THAT(tampered.output, HasSubstr("not what was committed to"));
}

TEST_F(CommandLine, ConcealRefusesABadBenchAndWritesNothing) {
  folder_.write("bench.toml", "schema = \"flexspline-bench/1\"\nrig = \"lockd\"\neffects = []\n");
  const Finished done = call("conceal " + path("bench.toml") + " --out " + path("out"));
  EXPECT_EQ(done.code, 65);
  EXPECT_THAT(done.output, HasSubstr("bench.toml:2:7"));
  EXPECT_EQ(call("validate " + path("bench.toml")).code, 65);
  EXPECT_EQ(call("conceal " + path("bench.toml") + " --salt x --out " + path("out")).code, 2);
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

TEST_F(CommandLine, TrialKeepsRecordingsBesideItsFolderOnly) {
  folder_.write("trial.toml",
                "schema = \"flexspline-trial/1\"\nname = \"one\"\nseed = 1\nrigs = "
                "[\"locked\"]\ncases = 1\n[draw]\nnone = 1.0\n");
  const Finished done = call("trial " + path("trial.toml") + " --out " + path("out") +
                             " --recordings " + path("out/kept"));
  EXPECT_EQ(done.code, 2);
  EXPECT_THAT(done.output, HasSubstr("lies in --out"));
  EXPECT_FALSE(std::filesystem::exists(path("out"))) << "a refusal leaves nothing";
}

TEST_F(CommandLine, SimulateRefusesAnAmplitudeInTheWrongUnit) {
  folder_.write("model.toml",
                read_text(std::string(FLEXSPLINE_SOURCE_DIR) + "/tests/studies/cubic_model.toml"));
  const Finished done =
      call("simulate " + path("model.toml") +
           " --excitation sine --amplitude 0.2Nm --frequency 0.005Hz --out " + path("set"));
  EXPECT_EQ(done.code, 2);
  EXPECT_THAT(done.output, HasSubstr("unit of angle"));
}

}  // namespace
}  // namespace flexspline::studies
