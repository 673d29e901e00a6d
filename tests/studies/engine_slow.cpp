#include <chrono>
#include <fstream>
#include <map>
#include <random>
#include <thread>

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "flexspline/core/case_store.hpp"
#include "study_file.hpp"
#include "toy_cases.hpp"

namespace flexspline::studies {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

EngineSettings settings_in(const std::filesystem::path& folder, Shard shard = {}) {
  EngineSettings settings;
  settings.folder = folder;
  settings.jobs = 2;
  settings.shard = shard;
  return settings;
}

pid_t start(std::size_t size, std::chrono::microseconds each, const EngineSettings& settings) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  ToyCases cases(size, each);
  static_cast<void>(run_cases(cases, settings));
  ::_exit(0);
}

void expect_whole(const std::filesystem::path& folder, std::size_t size) {
  ToyCases cases(size);
  const auto rest = run_cases(cases, settings_in(folder));
  ASSERT_TRUE(rest) << rest.error().message();
  const auto store = CaseStore::open(folder);
  ASSERT_TRUE(store);
  ASSERT_EQ(store->size(), size);
  ASSERT_EQ(store->keys().size(), size);
  EXPECT_TRUE(store->damaged().empty());
  for (std::size_t i = 0; i < size; ++i) {
    const auto one = store->read(cases.name(i).key);
    ASSERT_TRUE(one) << one.error().message();
    EXPECT_EQ(one->artefact, cases.compute(i).artefact);
  }
}

// The moments are drawn by a seed; what they hit differs from run to run, the result does not.
TEST(EngineSlow, AHundredKillsLoseNothing) {
  const ScratchFolder folder;
  std::mt19937 draw(22);
  for (int k = 0; k < 100; ++k) {
    std::vector<pid_t> children;
    if (k % 2 == 0) {
      children.push_back(start(200, 50ms, settings_in(folder.path())));
    } else {
      for (std::size_t s : {1U, 2U}) {
        children.push_back(start(200, 50ms, settings_in(folder.path(), {s, 2})));
      }
    }
    std::this_thread::sleep_for(std::chrono::microseconds(draw() % 90'000));
    for (const pid_t child : children) {
      ::kill(child, SIGKILL);
      int status = 0;
      ::waitpid(child, &status, 0);
    }
  }
  expect_whole(folder.path(), 200);
}

// Taking out of the journals what is stale is a merge, too.
TEST(EngineSlow, KillsWhileStaleCasesAreSetAsideLoseNothing) {
  const ScratchFolder folder;
  std::mt19937 draw(23);
  for (int k = 0; k < 30; ++k) {
    {
      ToyCases many(60'000, {}, false);
      ASSERT_TRUE(run_cases(many, settings_in(folder.path())));
    }
    const pid_t child = start(30'000, {}, settings_in(folder.path()));
    std::this_thread::sleep_for(std::chrono::microseconds(draw() % 400'000));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    const auto store = CaseStore::open(folder.path());
    ASSERT_TRUE(store);
    ASSERT_GE(store->size(), 30'000U) << k;
  }
}

TEST(EngineSlow, AMillionCasesTakeLittle) {
  const ScratchFolder folder;
  ToyCases cases(1'000'000, {}, false);
  const auto begun = Clock::now();
  const auto summary = run_cases(cases, settings_in(folder.path()));
  const double seconds = std::chrono::duration<double>(Clock::now() - begun).count();
  ASSERT_TRUE(summary) << summary.error().message();
  EXPECT_EQ(summary->computed, 1'000'000U);
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  std::printf("%.4f ms a case, %.0f MB\n", 1e3 * seconds / 1e6,
              static_cast<double>(usage.ru_maxrss) / 1e3);
  EXPECT_LE(1e3 * seconds / 1e6, 0.2);
  EXPECT_LE(journals_in(folder.path() / "journals").size(), 200U);
  const auto again = run_cases(cases, settings_in(folder.path()));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->reused, 1'000'000U);
  ::getrusage(RUSAGE_SELF, &usage);
  EXPECT_LE(static_cast<double>(usage.ru_maxrss) / 1e6, 1.05) << "GB";
}

/// A file system that is soon full; needs the right to mount.
class FullDisk : public testing::Test {
 protected:
  void SetUp() override {
    place_ = folder_.path() / "small";
    std::filesystem::create_directories(place_);
    mounted_ = ::mount("none", place_.c_str(), "tmpfs", 0, "size=256k") == 0;
    if (!mounted_) GTEST_SKIP() << "needs the right to mount a tmpfs";
  }
  void TearDown() override {
    if (mounted_) ::umount2(place_.c_str(), MNT_DETACH);
  }

  ScratchFolder folder_;
  std::filesystem::path place_;
  bool mounted_ = false;
};

TEST_F(FullDisk, IsAClearErrorAndWhatIsThereIsWhole) {
  ToyCases cases(20'000, {}, false);
  const auto full = run_cases(cases, settings_in(place_));
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error().code, ErrorCode::cannot_write);
  EXPECT_NE(full.error().problem.find("No space left"), std::string::npos) << full.error().problem;
  const auto store = CaseStore::open(place_);
  ASSERT_TRUE(store) << store.error().message();
  EXPECT_GT(store->size(), 100U);
  EXPECT_TRUE(store->damaged().empty());
  ASSERT_EQ(::mount("none", place_.c_str(), "tmpfs", MS_REMOUNT, "size=64m"), 0);
  const auto rest = run_cases(cases, settings_in(place_));
  ASSERT_TRUE(rest) << rest.error().message();
  EXPECT_GE(rest->reused, store->size());
  EXPECT_EQ(CaseStore::open(place_)->size(), 20'000U);
}

}  // namespace
}  // namespace flexspline::studies
