// The system's clock may be set while a study runs: leases, limits, progress and results know
// nothing of it.
#include <future>
#include <thread>

#include <fmt/format.h>

#include "flexspline/core/case_store.hpp"
#include "program_fixture.hpp"

namespace flexspline::studies {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using namespace std::chrono_literals;

/// libfaketime, which gives a program another time of day than the system's; empty where there is
/// none.
fs::path faketime() {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator("/usr/lib", error)) {
    const fs::path library = entry.path() / "faketime" / "libfaketimeMT.so.1";
    if (fs::exists(library, error)) return library;
  }
  return {};
}

/// The program under a time of day that jumps by days, to and fro, every few milliseconds.
class JumpingClock : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    if (IsSkipped()) return;
    library_ = faketime();
    if (library_.empty()) GTEST_SKIP() << "libfaketime is not installed (faketime)";
    std::string study = kSmallStudy;
    study.insert(study.find("[bench]"), "replicates = 200\n");
    folder_.write("study.toml", study);
  }

  /// From now on the program is told the time of day that jumps, and the true time that has passed.
  void jump_from_now_on() {
    jump(0);
    setenv("FAKETIME_TIMESTAMP_FILE", path("time-of-day").c_str(), 1);
    setenv("FAKETIME_NO_CACHE", "1", 1);
    setenv("FAKETIME_DONT_FAKE_MONOTONIC", "1", 1);
    setenv("LD_PRELOAD", library_.c_str(), 1);
    jumps_ = std::jthread([this](const std::stop_token& stop) {
      for (int k = 1; !stop.stop_requested(); ++k) {
        jump(k);
        std::this_thread::sleep_for(5ms);
      }
    });
  }
  void TearDown() override {
    for (const char* name : {"LD_PRELOAD", "FAKETIME_TIMESTAMP_FILE", "FAKETIME_NO_CACHE",
                             "FAKETIME_DONT_FAKE_MONOTONIC"}) {
      unsetenv(name);
    }
  }
  Ended run(const std::string& out, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"run", path("study.toml"), "--out", path(out), "--jobs", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  }
  std::map<std::string, std::string> artefacts(const std::string& name) const {
    std::map<std::string, std::string> found;
    const auto store = CaseStore::open(path(name));
    EXPECT_TRUE(store);
    if (!store) return found;
    for (const std::string& key : store->keys()) found[key] = store->read(key)->artefact;
    return found;
  }

 private:
  void jump(int k) const {
    constexpr int kDays[] = {0, 3, -5, 400, -400};
    folder_.write("next", fmt::format("{:+}d\n", kDays[k % std::size(kDays)]));
    fs::rename(path("next"), path("time-of-day"));
  }

  fs::path library_;
  std::jthread jumps_;
};

/// Lines that tell how far a study is: one at its beginning, and one a minute.
std::size_t progress_lines(const std::string& said) {
  std::size_t lines = 0;
  for (auto at = said.find(" cases, "); at != said.npos; at = said.find(" cases, ", at + 1)) {
    ++lines;
  }
  return lines;
}

TEST_F(JumpingClock, NeitherEndsACaseNorChangesAResult) {
  ASSERT_EQ(run("once").code, 0);
  jump_from_now_on();
  const Ended ended = run("out", {"--case-seconds", "60"});
  EXPECT_EQ(ended.code, 0) << ended.said;
  EXPECT_THAT(ended.said, HasSubstr(" 0 failed"));
  EXPECT_LE(progress_lines(ended.said), 2U + static_cast<std::size_t>(ended.seconds / 60.0))
      << ended.said;
  EXPECT_EQ(artefacts("out"), artefacts("once"));
}

TEST_F(JumpingClock, NeitherFreesNorHoldsALease) {
  ASSERT_EQ(run("once").code, 0);
  jump_from_now_on();
  auto other = std::async(std::launch::async, [&] {
    return run("out", {"--shard", "1/2", "--pull"});
  });
  const Ended one = run("out", {"--shard", "2/2", "--pull"});
  const Ended two = other.get();
  EXPECT_EQ(one.code, 0) << one.said;
  EXPECT_EQ(two.code, 0) << two.said;
  std::size_t records = 0;
  for (const auto& file : journals_in(path("out/journals"))) {
    records += scan_journal(file, [](JournalFields, RecordPlace) {})->records;
  }
  EXPECT_EQ(records, 200U) << "none twice";
  const Ended gathered = run("out", {"--gather"});
  EXPECT_EQ(gathered.code, 0) << gathered.said;
  EXPECT_EQ(artefacts("out"), artefacts("once"));
}

}  // namespace
}  // namespace flexspline::studies
