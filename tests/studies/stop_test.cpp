#include "program_fixture.hpp"
#include "stored.hpp"

namespace flexspline::studies {
namespace {

/// Inputs that keep every command at work for far longer than a test.
class AskedToStop : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    if (IsSkipped()) return;
    ASSERT_EQ(simulate("set", {"--cycles", "40", "--samples", "20000"}).code, 0);
    std::string bench = kSmallBench;
    for (std::size_t at = 0; (at = bench.find("samples = 200", at)) != std::string::npos; ++at) {
      bench.replace(at, 13, "samples = 400000");
    }
    folder_.write("long.toml", bench);
    folder_.write("trial.toml",
                  "schema = \"flexspline-trial/1\"\nname = \"t\"\nseed = 1\nrigs = [\"free\"]\n"
                  "cases = 50\n[draw]\none = 1\n");
  }

  void expect_stops(const std::vector<std::string>& words, int signal) const {
    Call call{words};
    call.limit = 0.3;
    call.stop_signal = signal;
    const Ended ended = run_program(call);
    SCOPED_TRACE(words.front() + ": " + ended.said);
    ASSERT_TRUE(ended.stopped) << "too short to tell, " << ended.seconds << " s";
    EXPECT_EQ(ended.signal, 0);
    EXPECT_EQ(ended.code, 75);
    EXPECT_LT(ended.stopping, 2.0);
    for (const auto& [file, sum] : hashes(folder_.path())) {
      EXPECT_FALSE(file.ends_with(".part")) << file << " is half-written";
    }
  }
};

TEST_F(AskedToStop, EveryLongCommandStopsWithinTwoSeconds) {
  const std::string out = path("out");
  const std::vector<std::string> fit = {"fit",    path("set"), "--out",  out + "/fit",
                                        "--rows", "all",       "--model"};
  std::vector<std::string> given = fit;
  given.push_back(path("model.toml"));
  expect_stops(given, SIGINT);
  expect_stops({"fit", path("set"), "--estimator", "trajectory_ceres", "--rows", "all", "--out",
                out + "/ceres"},
               SIGTERM);
  expect_stops({"compare", path("set"), "--estimators", "bouc_wen,trajectory_ceres", "--out",
                out + "/compare"},
               SIGINT);
  expect_stops({"diagnose", path("set"), "--rows", "all", "--out", out + "/diagnose"}, SIGTERM);
  expect_stops({"conceal", path("long.toml"), "--out", out + "/conceal"}, SIGINT);
  expect_stops({"trial", path("trial.toml"), "--jobs", "1", "--out", out + "/trial"}, SIGTERM);
  expect_stops({"selftest"}, SIGINT);
  expect_stops({"simulate", path("model.toml"), "--like", path("set"), "--direction", "torsion",
                "--out", out + "/simulate"},
               SIGTERM);
}

// What was finished before counts: the study goes on.
TEST_F(AskedToStop, AStudyGoesOnFromWhatIsFinished) {
  std::string study = kSmallStudy;
  study.replace(study.find("samples_per_cycle = 200"), 23, "samples_per_cycle = 20000");
  study.insert(study.find("[bench]"), "replicates = 400\n");
  folder_.write("study.toml", study);
  Call call{{"run", path("study.toml"), "--jobs", "1", "--out", path("out")}};
  call.limit = 1.0;
  call.ready = [&] {
    const auto store = CaseStore::open(path("out"));
    return store && store->size() > 0;
  };
  const Ended ended = run_program(call);
  ASSERT_EQ(ended.code, 75) << ended.said;
  EXPECT_LT(ended.stopping, 2.0);
  const auto left = CaseStore::open(path("out"));
  ASSERT_TRUE(left) << left.error().message();
  EXPECT_GT(left->size(), 0U);
  EXPECT_TRUE(left->damaged().empty());
  std::map<std::string, std::string> before;
  for (const std::string& key : left->keys()) before[key] = left->read(key)->artefact;
  call.limit = 1.0;
  call.ready = nullptr;
  EXPECT_EQ(run_program(call).code, 75);
  for (const auto& [key, artefact] : before) {
    EXPECT_EQ(stored_case(path("out"), key).artefact, artefact) << key;
  }
}

}  // namespace
}  // namespace flexspline::studies
