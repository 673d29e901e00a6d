#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "flexspline/data/artefact.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/studies/results.hpp"
#include "flexspline/studies/run.hpp"
#include "stored.hpp"
#include "study_file.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

const std::string kBench =
    "[bench]\nangle_noise = { value = 0.1, unit = \"%\" }\ntorque_noise_white = { value = 0.1, "
    "unit = \"%\" }\n"
    "cycles = 3\nsamples_per_cycle = 200\n";
const std::string kSecondEstimator =
    "[[estimator]]\nid = \"pooled\"\nmethod = \"midpoint_pooled\"\ntrain = \"point\"\n";

class RunStudy : public testing::Test {
 protected:
  StudyConfig load(const std::string& text) const {
    const auto study = load_study(folder_.write("study.toml", text));
    EXPECT_TRUE(study.has_value()) << (study ? "" : study.error().message());
    return study.value_or(StudyConfig{});
  }
  std::filesystem::path out() const { return folder_.path() / "out"; }
  Result<RunSummary> run(const StudyConfig& study, const std::string& build = "build",
                         const std::atomic<bool>* stop = nullptr, int jobs = 2) const {
    const auto plan = plan_study(study, build);
    if (!plan) return tl::unexpected(plan.error());
    RunSettings settings;
    settings.folder = out();
    settings.jobs = jobs;
    settings.build_id = build;
    settings.stop = stop;
    return run_study(*plan, settings);
  }
  ordered_json artefact(const std::string& key) const { return stored_artefact(out(), key); }

  std::string journals() const {
    std::string text;
    for (const auto& file : journals_in(out() / "journals")) text += read_text(file);
    return text;
  }

  ScratchFolder folder_;
  const std::string text_ = kHead + kBench + kGrid + kInput + kEstimator + kSecondEstimator;
};

TEST_F(RunStudy, WritesEveryArtefact) {
  const auto summary = run(load(text_));
  ASSERT_TRUE(summary.has_value()) << summary.error().message();
  EXPECT_EQ(summary->computed, 2U);
  EXPECT_TRUE(summary->failed.empty());
  EXPECT_TRUE(exists(out() / "study.lock.toml"));
  EXPECT_TRUE(
      data::read_artefact(out() / "inputs" / "unity.json", "flexspline-input/1").has_value());
  const ordered_json one = artefact("unity--paper--r0");
  EXPECT_EQ(one["status"], "done");
  ASSERT_EQ(one["recordings"].size(), 2U);
  EXPECT_EQ(one["recordings"][0]["role"], "train");
  EXPECT_EQ(one["recordings"][1]["id"], "holdout/a0.2000-f0.00500");
  EXPECT_EQ(one["recordings"][1]["role"], "holdout");
  EXPECT_LT(one["recordings"][1]["rmse_true_percent_of_peak"].get<double>(), 1.0);
  EXPECT_LE(one["recordings"][0]["motion"].size(), 400U);
  EXPECT_TRUE(one["function_errors_percent"]["h"].is_null()) << "the paper's fit has no h";
}

TEST_F(RunStudy, SecondRunRedoesNothing) {
  const StudyConfig study = load(text_);
  ASSERT_TRUE(run(study).has_value());
  const std::string before = journals();
  const auto again = run(study);
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->computed, 0U);
  EXPECT_EQ(again->reused, 2U);
  EXPECT_EQ(journals(), before);
}

TEST_F(RunStudy, TamperedArtefactIsRedone) {
  const StudyConfig study = load(text_);
  ASSERT_TRUE(run(study).has_value());
  for (const auto& file : journals_in(out() / "journals")) {
    std::string text = read_text(file);
    const auto at = text.find("\"key\":\"unity--paper--r0\"");
    if (at == std::string::npos) continue;
    text.replace(text.find_first_of("0123456789", text.find("\"seed\"", at)), 1, "9");
    std::ofstream(file) << text;
  }
  const auto again = run(study);
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->computed, 1U);
  ASSERT_EQ(again->damaged.size(), 1U);
  EXPECT_NE(again->damaged[0].find("1 damaged record"), std::string::npos);
  EXPECT_EQ(artefact("unity--paper--r0")["seed"], 1);
}

TEST_F(RunStudy, TruncatedArtefactIsRedone) {
  const StudyConfig study = load(text_);
  ASSERT_TRUE(run(study).has_value());
  const auto file = journals_in(out() / "journals").back();
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 100);
  const auto again = run(study);
  EXPECT_EQ(again->computed, 1U);
  EXPECT_TRUE(again->damaged.empty()) << "a torn tail is no damage";
}

TEST_F(RunStudy, OtherSeedOrBuildIsAnotherResult) {
  ASSERT_TRUE(run(load(text_)).has_value());
  EXPECT_EQ(run(load(text_), "another build")->computed, 2U);
  const std::string reseeded = kHead + "seed = 5\n" + kBench + kGrid + kInput + kEstimator;
  EXPECT_EQ(run(load(reseeded), "another build")->computed, 1U);
}

TEST_F(RunStudy, CasesNoLongerInTheStudyAreSetAside) {
  ASSERT_TRUE(run(load(text_)).has_value());
  ASSERT_TRUE(run(load(kHead + kBench + kGrid + kInput + kEstimator)).has_value());
  EXPECT_EQ(CaseStore::open(out())->keys(), std::vector<std::string>{"unity--paper--r0"});
  std::string stale;
  for (const auto& entry : std::filesystem::directory_iterator(out() / "journals")) {
    if (entry.path().extension() == ".stale") stale += read_text(entry.path());
  }
  EXPECT_NE(stale.find("\tunity--pooled--r0\t"), std::string::npos) << "nothing is lost";
}

TEST_F(RunStudy, ReplicatesDifferByTheirNoise) {
  ASSERT_TRUE(
      run(load(kHead + "replicates = 2\n" + kBench + kGrid + kInput + kEstimator)).has_value());
  const auto first = artefact("unity--paper--r0")["recordings"][0]["rmse"].get<double>();
  const auto second = artefact("unity--paper--r1")["recordings"][0]["rmse"].get<double>();
  EXPECT_NE(first, second);
  EXPECT_NEAR(first / second, 1.0, 0.5);
}

TEST_F(RunStudy, NumberOfWorkersDoesNotMatter) {
  const StudyConfig study = load(text_);
  const auto result = [&](int jobs) {
    std::filesystem::remove_all(out());
    EXPECT_TRUE(run(study, "build", nullptr, jobs).has_value());
    return stored_case(out(), "unity--paper--r0").artefact;
  };
  EXPECT_EQ(result(1), result(4));
}

TEST_F(RunStudy, AskedToStopItStartsNoCase) {
  const std::atomic<bool> stop = true;
  const auto summary = run(load(text_), "build", &stop);
  ASSERT_TRUE(summary.has_value());
  EXPECT_TRUE(summary->interrupted);
  EXPECT_EQ(summary->computed, 0U);
  EXPECT_EQ(run(load(text_))->computed, 2U);
}

TEST_F(RunStudy, FolderThatCannotBeWrittenIsNamed) {
  folder_.write("out", "a file where the folder should be");
  const auto summary = run(load(text_));
  ASSERT_FALSE(summary.has_value());
  EXPECT_EQ(summary.error().code, ErrorCode::cannot_write);
  EXPECT_NE(summary.error().message().find(out().string()), std::string::npos);
}

/// A specimen pulled once: there is no loop to take midpoints of.
RecordingSet ramp() {
  RecordingSet set;
  set.name = "ramp";
  set.rig = Rig::specimen;
  set.license = "CC0-1.0";
  Recording recording;
  recording.id = "pull";
  recording.excitation = "ramp";
  for (int i = 0; i < 200; ++i) {
    recording.time.push_back(0.01 * i);
    recording.channels[Quantity::torsion].push_back(1e-4 * i);
    recording.channels[Quantity::torque].push_back(0.1 * i + 0.01 * std::sin(i));
  }
  set.recordings.push_back(recording);
  return set;
}

/// A loop of a linear spring with a viscous damper, three cycles.
RecordingSet loop() {
  RecordingSet set;
  set.name = "loop";
  set.rig = Rig::specimen;
  Recording recording;
  recording.id = "sine";
  std::vector<double> torsion;
  std::vector<double> torque;
  for (int i = 0; i < 300; ++i) {
    const double angle = 2.0 * 3.141592653589793 * i / 100.0;
    recording.time.push_back(0.01 * i);
    torsion.push_back(0.01 * std::sin(angle));
    torque.push_back(20.0 * std::sin(angle) + 2.0 * std::cos(angle));
  }
  recording.channels[Quantity::torsion] = torsion;
  recording.channels[Quantity::torque] = torque;
  set.recordings.push_back(recording);
  return set;
}

// Replicates of a data set, and rows that differ by their names alone, are one fit: its time of
// computing, which no second fit would repeat, tells.
TEST_F(RunStudy, FitsTheSameDataByTheSameMethodOnce) {
  ASSERT_TRUE(data::write_dataset(folder_.path() / "loop", loop()).has_value());
  const std::string row = "method = \"trajectory_ceres\"\n";
  const auto study =
      load(kHead + "replicates = 2\n[[input]]\nid = \"loop\"\ndataset = \"loop\"\n" +
           "[[estimator]]\nid = \"a\"\n" + row + "[[estimator]]\nid = \"b\"\n" + row +
           "[[estimator]]\nid = \"c\"\n" + row + "options = { samples = 100 }\n");
  const auto summary = run(study);
  ASSERT_TRUE(summary.has_value()) << summary.error().message();
  ASSERT_EQ(summary->computed, 6U);
  const auto seconds = [&](const std::string& key) { return stored_case(out(), key).seconds; };
  EXPECT_EQ(seconds("loop--a--r0"), seconds("loop--a--r1"));
  EXPECT_EQ(seconds("loop--a--r0"), seconds("loop--b--r1"));
  EXPECT_NE(seconds("loop--a--r0"), seconds("loop--c--r0"));
  EXPECT_NE(artefact("loop--a--r0")["depends_on"], artefact("loop--b--r0")["depends_on"]);
}

TEST_F(RunStudy, FailingCaseDoesNotStopTheStudy) {
  ASSERT_TRUE(data::write_dataset(folder_.path() / "ramp", ramp()).has_value());
  const auto study = load(kHead + kBench + kGrid +
                          "[[input]]\nid = \"ramp\"\ndataset = \"ramp\"\n" + kInput + kEstimator);
  const auto summary = run(study);
  ASSERT_TRUE(summary.has_value()) << summary.error().message();
  EXPECT_EQ(summary->computed, 2U);
  ASSERT_EQ(summary->failed.size(), 1U);
  const ordered_json failed = artefact("ramp--paper--r0");
  EXPECT_EQ(failed["status"], "failed");
  EXPECT_TRUE(failed["estimate"].is_null());
  EXPECT_FALSE(failed["failure"]["problem"].get<std::string>().empty());
  EXPECT_EQ(artefact("unity--paper--r0")["status"], "done");
  const auto again = run(study);
  EXPECT_EQ(again->computed, 0U);
  EXPECT_EQ(again->failed.size(), 1U) << "a failure taken over is still a failure";
}

TEST_F(RunStudy, ResultsAreHdf5AndLeaveNothingHalfWritten) {
  const StudyConfig study = load(text_);
  const auto summary = run(study);
  ASSERT_TRUE(summary.has_value());
  const auto plan = plan_study(study, "build");
  const auto rows = StudyRows::open(*plan, out());
  ASSERT_TRUE(rows);
  ASSERT_TRUE(write_results(*rows, {}, out()).has_value());
  EXPECT_EQ(read_text(out() / "results.nc").substr(1, 3), "HDF");
  EXPECT_FALSE(exists(out() / ".results.nc.part"));
  const auto nowhere = write_results(*rows, {}, out() / "none");
  ASSERT_FALSE(nowhere.has_value());
  EXPECT_EQ(nowhere.error().code, ErrorCode::cannot_write);
}

TEST_F(RunStudy, MissingDatasetIsNamed) {
  const auto summary = run(
      load(kHead + "[[input]]\nid = \"a\"\ndataset = \"nowhere\"\n[[estimator]]\nid = \"paper\"\n"
                   "method = \"midpoint_polynomial\"\n"));
  ASSERT_FALSE(summary.has_value());
  EXPECT_EQ(summary.error().code, ErrorCode::input_missing);
  EXPECT_NE(summary.error().message().find("nowhere"), std::string::npos);
}

}  // namespace
}  // namespace flexspline::studies
