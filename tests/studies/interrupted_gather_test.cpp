// Results and report are made of the cases alone: however often that is ended half-way, repeated it
// comes to the same bytes.
#include <random>

#include "program_fixture.hpp"

namespace flexspline::studies {
namespace {

namespace fs = std::filesystem;

/// Number of kills; FLEXSPLINE_KILLS gives another.
int kills() {
  const char* given = std::getenv("FLEXSPLINE_KILLS");
  return given != nullptr ? std::atoi(given) : 10;
}

class InterruptedGather : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    if (IsSkipped()) return;
    std::string study = kSmallStudy;
    study.insert(study.find("[bench]"), "replicates = 30\n");
    folder_.write("study.toml", study);
  }
  Call gather(const std::string& out) const {
    return Call{{"run", path("study.toml"), "--out", path(out), "--gather", "--quiet"}};
  }
  /// Every file of a folder by its path in there; half-written ones have names of their own.
  std::map<std::string, std::string> content(const std::string& out) const {
    std::map<std::string, std::string> sums;
    for (const auto& [file, sum] : hashes(path(out))) {
      if (file.ends_with(".part")) continue;
      sums[fs::path(file).lexically_relative(path(out)).generic_string()] = sum;
    }
    return sums;
  }
};

TEST_F(InterruptedGather, RepeatedComesToTheSameBytes) {
  for (const char* shard : {"1/2", "2/2"}) {
    ASSERT_EQ(run_program({"run", path("study.toml"), "--out", path("out"), "--shard", shard}).code,
              0);
  }
  fs::copy(path("out"), path("once"), fs::copy_options::recursive);
  const Ended undisturbed = run_program(gather("once"));
  ASSERT_EQ(undisturbed.code, 0) << undisturbed.said;
  std::mt19937 draw(29);
  for (int k = 0; k < kills(); ++k) {
    Call call = gather("out");
    call.limit = undisturbed.seconds * static_cast<double>(draw() % 1000) / 1000.0;
    call.stop_signal = SIGKILL;
    run_program(call);
  }
  const Ended ended = run_program(gather("out"));
  ASSERT_EQ(ended.code, 0) << ended.said;
  EXPECT_EQ(content("out"), content("once"));
}

}  // namespace
}  // namespace flexspline::studies
