#include <cstdlib>
#include <random>

#include "program_fixture.hpp"
#include "stored.hpp"

namespace flexspline::studies {
namespace {

/// A study of many small cases, through the program.
class Shards : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    if (IsSkipped()) return;
    std::string study = kSmallStudy;
    study.insert(study.find("[bench]"), "replicates = 200\n");
    folder_.write("study.toml", study);
  }

  /// Artefacts of a folder by their keys.
  std::map<std::string, std::string> artefacts(const std::string& name) const {
    std::map<std::string, std::string> found;
    const auto store = CaseStore::open(path(name));
    EXPECT_TRUE(store);
    if (!store) return found;
    EXPECT_TRUE(store->damaged().empty());
    for (const std::string& key : store->keys()) found[key] = store->read(key)->artefact;
    return found;
  }
  std::map<std::string, std::string> undisturbed() const {
    EXPECT_EQ(run_program({"run", path("study.toml"), "--out", path("once"), "--jobs", "2"}).code,
              0);
    return artefacts("once");
  }
  static bool on_path(const std::string& program) {
    return std::system(("command -v " + program + " > /dev/null 2>&1").c_str()) == 0;
  }
  static std::string example(const std::string& name) {
    return std::string(FLEXSPLINE_SOURCE_DIR) + "/docs/examples/clusters/" + name;
  }
  int shell(const std::string& command) const {
    const std::string line = "cd '" + folder_.path().string() + "' && FLEXSPLINE='" +
                             program_path().string() + "' " + command + " > shell.log 2>&1";
    return std::system(line.c_str());
  }
};

TEST_F(Shards, KilledAtAHundredMomentsTheResultIsTheSame) {
  const auto expected = undisturbed();
  ASSERT_EQ(expected.size(), 200U);
  std::mt19937 draw(5);
  for (int k = 0; k < 100; ++k) {
    Call call{{"run", path("study.toml"), "--out", path("out"), "--jobs", "2"}};
    if (k % 3 == 1) call.arguments.insert(call.arguments.end(), {"--shard", "1/2"});
    if (k % 3 == 2) call.arguments.insert(call.arguments.end(), {"--shard", "2/2"});
    if (k % 3 > 0 && k % 2 == 0) call.arguments.emplace_back("--pull");
    call.limit = 1e-3 * static_cast<double>(draw() % 400);
    call.stop_signal = SIGKILL;
    run_program(call);
  }
  const Ended last = run_program({"run", path("study.toml"), "--out", path("out"), "--jobs", "2"});
  EXPECT_EQ(last.code, 0) << last.said;
  EXPECT_EQ(artefacts("out"), expected);
}

TEST_F(Shards, LimitsWorkThroughTheProgram) {
  const Ended ended = run_program({"run", path("study.toml"), "--out", path("out"), "--jobs", "2",
                                   "--case-seconds", "30", "--case-memory", "2000"});
  EXPECT_EQ(ended.code, 0) << ended.said;
  EXPECT_EQ(artefacts("out"), undisturbed());
}

TEST_F(Shards, GnuParallelRunsTheExample) {
  if (!on_path("parallel")) GTEST_SKIP() << "GNU parallel is not installed";
  EXPECT_EQ(shell("sh '" + example("parallel.sh") + "' study.toml out 4 --will-cite -j2"), 0)
      << read_text(path("shell.log"));
  EXPECT_EQ(artefacts("out"), undisturbed());
  EXPECT_TRUE(exists(folder_.path() / "out" / "report" / "index.html"));
}

TEST_F(Shards, SnakemakeRunsTheExample) {
  if (!on_path("snakemake")) GTEST_SKIP() << "Snakemake is not installed";
  EXPECT_EQ(shell("snakemake -s '" + example("Snakefile") +
                  "' --cores 2 --config study=study.toml out=out shards=4"),
            0)
      << read_text(path("shell.log"));
  EXPECT_EQ(artefacts("out"), undisturbed());
}

/// A Slurm of this test's own: three nodes on this machine.
class OnSlurm : public Shards {
 protected:
  void SetUp() override {
    Shards::SetUp();
    if (IsSkipped()) return;
    tools_ =
        std::filesystem::path(FLEXSPLINE_SOURCE_DIR).parent_path() / "shared" / "tools" / "slurm";
    if (!on_path("slurmctld") && !exists(std::filesystem::path("/usr/sbin/slurmctld"))) {
      GTEST_SKIP() << "Slurm is not installed";
    }
    if (!exists(tools_ / "up.sh")) GTEST_SKIP() << "no script to start a Slurm with";
    up_ = shell("bash '" + (tools_ / "up.sh").string() + "' slurm 3") == 0;
    if (!up_) GTEST_SKIP() << "Slurm does not start: " << read_text(path("shell.log"));
    setenv("SLURM_CONF", path("slurm/slurm.conf").c_str(), 1);
  }
  void TearDown() override {
    if (up_) shell("bash '" + (tools_ / "down.sh").string() + "' slurm");
    unsetenv("SLURM_CONF");
  }

  std::filesystem::path tools_;
  bool up_ = false;
};

TEST_F(OnSlurm, AStudyRunsAsAJobArray) {
  Call call{
      {"run", path("study.toml"), "--out", path("out"), "--engine", "slurm", "--elements", "6"}};
  call.limit = 300.0;
  const Ended ended = run_program(call);
  EXPECT_EQ(ended.code, 0) << ended.said;
  EXPECT_EQ(artefacts("out"), undisturbed());
  EXPECT_TRUE(exists(folder_.path() / "out" / "report" / "index.html"));
}

}  // namespace
}  // namespace flexspline::studies
