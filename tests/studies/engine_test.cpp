#include "flexspline/studies/engine.hpp"

#include <functional>
#include <map>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "flexspline/core/case_store.hpp"
#include "flexspline/core/write_file.hpp"
#include "study_file.hpp"
#include "toy_cases.hpp"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FLEXSPLINE_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define FLEXSPLINE_SANITIZED
#endif
#endif

namespace flexspline::studies {
namespace {

using namespace std::chrono_literals;

/// Waits until a condition holds, however busy the machine is; false after a minute without.
bool eventually(const std::function<bool()>& holds) {
  const auto end = std::chrono::steady_clock::now() + 60s;
  while (!holds()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

/// Toy cases that tell how many of them were computed, after each.
class TellingCases : public ToyCases {
 public:
  TellingCases(std::size_t size, std::chrono::microseconds each,
               std::function<void(std::size_t)> tell)
      : ToyCases(size, each), tell_(std::move(tell)) {}
  CaseResult compute(std::size_t number) override {
    CaseResult result = ToyCases::compute(number);
    tell_(++computed_);
    return result;
  }

 private:
  std::function<void(std::size_t)> tell_;
  std::atomic<std::size_t> computed_{0};
};

class Engine : public testing::Test {
 protected:
  EngineSettings settings(int jobs = 2, Shard shard = {}) const {
    EngineSettings settings;
    settings.folder = folder_.path();
    settings.jobs = jobs;
    settings.shard = shard;
    return settings;
  }
  /// Every artefact by its key.
  std::map<std::string, std::string> artefacts() const {
    std::map<std::string, std::string> found;
    const auto store = CaseStore::open(folder_.path());
    EXPECT_TRUE(store) << store.error().message();
    for (const std::string& key : store->keys()) found[key] = store->read(key)->artefact;
    return found;
  }
  /// Cases that were computed in a folder, whoever did; what a child has computed is what it adds.
  static std::size_t records_in(const std::filesystem::path& folder) {
    std::size_t count = 0;
    for (const auto& file : journals_in(folder / "journals")) {
      const auto scan = scan_journal(file, [](JournalFields, RecordPlace) {});
      if (scan) count += scan->records;
    }
    return count;
  }
  std::size_t records() const { return records_in(folder_.path()); }
  static void end(pid_t child) {
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
  }
  /// What an undisturbed run gives.
  static std::map<std::string, std::string> expected(std::size_t size) {
    std::map<std::string, std::string> all;
    ToyCases cases(size);
    for (std::size_t i = 0; i < size; ++i) all[cases.name(i).key] = cases.compute(i).artefact;
    return all;
  }

  ScratchFolder folder_;
};

TEST_F(Engine, ComputesEveryCaseOnceByAnyNumberOfWorkers) {
  for (const int jobs : {1, 2, 8}) {
    const ScratchFolder own;
    ToyCases cases(300);
    EngineSettings with = settings(jobs);
    with.folder = own.path();
    const auto summary = run_cases(cases, with);
    ASSERT_TRUE(summary) << summary.error().message();
    EXPECT_EQ(summary->computed, 300U);
    EXPECT_EQ(summary->failed, 42U);
    EXPECT_EQ(summary->failures.front(), "toy--0000006--r0: a 7th");
    EXPECT_FALSE(summary->interrupted);
    EXPECT_LE(journals_in(own.path() / "journals").size(), static_cast<std::size_t>(jobs));
    const auto again = run_cases(cases, with);
    EXPECT_EQ(again->computed, 0U);
    EXPECT_EQ(again->reused, 300U);
    EXPECT_EQ(again->failed, 42U);
  }
}

TEST_F(Engine, ShardsAreDisjointAndTheWhole) {
  for (const std::size_t total : {1U, 7U, 100U, 10'000U}) {
    for (const std::size_t count : {1U, 2U, 3U, 8U}) {
      std::vector<std::size_t> sizes(count);
      for (std::size_t number = 0; number < total; ++number) {
        std::size_t owners = 0;
        for (std::size_t index = 1; index <= count; ++index) {
          if (!Shard{index, count}.has(number, total)) continue;
          ++owners;
          ++sizes[index - 1];
        }
        EXPECT_EQ(owners, 1U) << number << " of " << total;
      }
      if (total < 100) continue;
      for (const std::size_t size : sizes) {
        EXPECT_GT(static_cast<double>(size), 0.8 * static_cast<double>(total / count));
      }
    }
  }
}

// Two processes on one folder at once, then whoever is there last: nothing is missing or twice.
TEST_F(Engine, TwoShardsAtOnceInOneFolder) {
  std::vector<pid_t> children;
  for (std::size_t index = 1; index <= 2; ++index) {
    const pid_t child = ::fork();
    if (child == 0) {
      ToyCases cases(400, 200us);
      const auto done = run_cases(cases, settings(2, {index, 2}));
      ::_exit(done && done->computed == done->cases ? 0 : 1);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
  }
  ToyCases cases(400);
  const auto rest = run_cases(cases, settings());
  ASSERT_TRUE(rest) << rest.error().message();
  EXPECT_EQ(rest->computed, 0U);
  EXPECT_EQ(artefacts(), expected(400));
}

TEST_F(Engine, GoesOnAfterBeingKilled) {
  for (std::size_t k = 1; k <= 5; ++k) {
    const pid_t child = ::fork();
    if (child == 0) {
      ToyCases cases(200, 2ms);
      static_cast<void>(run_cases(cases, settings()));
      ::_exit(0);
    }
    EXPECT_TRUE(eventually([&] { return records() >= 11 * k; }));
    end(child);
  }
  ToyCases cases(200);
  const auto rest = run_cases(cases, settings());
  ASSERT_TRUE(rest) << rest.error().message();
  EXPECT_GT(rest->reused, 0U);
  EXPECT_EQ(artefacts(), expected(200));
}

TEST_F(Engine, WhatThePlanHasNoMoreIsSetAside) {
  ToyCases more(50);
  ASSERT_TRUE(run_cases(more, settings()));
  ToyCases fewer(30);
  const auto summary = run_cases(fewer, settings());
  ASSERT_TRUE(summary) << summary.error().message();
  EXPECT_EQ(summary->reused, 30U);
  EXPECT_EQ(artefacts(), expected(30));
}

TEST_F(Engine, AStopEndsAfterTheCasesAtHand) {
  std::atomic<bool> stop = false;
  EngineSettings with = settings(2);
  with.stop = &stop;
  TellingCases cases(10'000, 1ms, [&](std::size_t computed) {
    if (computed == 20) stop = true;
  });
  const auto summary = run_cases(cases, with);
  ASSERT_TRUE(summary) << summary.error().message();
  EXPECT_TRUE(summary->interrupted);
  EXPECT_GE(summary->computed, 20U);
  EXPECT_LE(summary->computed, 22U) << "what either worker had at hand";
}

TEST_F(Engine, AFolderThatIsTakenAwayIsNamed) {
  EngineSettings with = settings(2);
  with.folder = folder_.path() / "out";
  std::jthread takes([&] {
    EXPECT_TRUE(eventually([&] { return records_in(with.folder) > 0; }));
    std::filesystem::rename(with.folder, folder_.path() / "elsewhere");
    std::filesystem::remove_all(folder_.path() / "elsewhere");
  });
  ToyCases cases(100'000, 100us);
  const auto summary = run_cases(cases, with);
  ASSERT_FALSE(summary);
  EXPECT_EQ(summary.error().code, ErrorCode::cannot_write);
  EXPECT_NE(summary.error().problem.find("out"), std::string::npos);
}

TEST_F(Engine, AReadOnlyFolderIsNamed) {
  std::filesystem::create_directories(folder_.path() / "out");
  ASSERT_TRUE(write_file(folder_.path() / "out" / "journals", "a file in the way"));
  EngineSettings with = settings(2);
  with.folder = folder_.path() / "out";
  ToyCases cases(10);
  const auto summary = run_cases(cases, with);
  ASSERT_FALSE(summary);
  EXPECT_EQ(summary.error().code, ErrorCode::cannot_write);
}

/// A case that takes until somebody else has done most of the others.
class OneSlowCase : public ToyCases {
 public:
  explicit OneSlowCase(std::function<bool()> others_done)
      : ToyCases(200, 1ms, false), others_done_(std::move(others_done)) {}
  CaseResult compute(std::size_t number) override {
    if (number == 3 && !eventually(others_done_)) {
      return give_up(number, {ErrorCode::numerics, "nobody went on without it", {}, {}});
    }
    return ToyCases::compute(number);
  }

 private:
  std::function<bool()> others_done_;
};

class Pullers : public Engine {
 protected:
  EngineSettings pulling(std::size_t index, double pack_seconds = 0.02, double lease = 60.0) const {
    EngineSettings with = settings(1, {index, 2});
    with.pulling = {true, pack_seconds, lease};
    return with;
  }
};

// With fixed halves each had 100: of more, the other one did what was the slow one's.
TEST_F(Pullers, ASlowCaseHoldsUpNobody) {
  OneSlowCase cases([this] { return records() >= 150; });
  const pid_t child = ::fork();
  if (child == 0) {
    static_cast<void>(run_cases(cases, pulling(1)));
    ::_exit(0);
  }
  const auto own = run_cases(cases, pulling(2));
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(own) << own.error().message();
  EXPECT_EQ(records(), 200U) << "none twice";
  const auto store = CaseStore::open(folder_.path());
  ASSERT_TRUE(store);
  EXPECT_EQ(store->size(), 200U);
  EXPECT_EQ(store->failed(), 0U);
}

TEST_F(Pullers, WhatAKilledOneHadIsTakenByTheOthers) {
  const pid_t child = ::fork();
  if (child == 0) {
    ToyCases cases(200, 5ms);
    static_cast<void>(run_cases(cases, pulling(1)));
    ::_exit(0);
  }
  EXPECT_TRUE(eventually([&] { return records() >= 20; }));
  end(child);
  ToyCases cases(200, 100us);
  const auto own = run_cases(cases, pulling(2, 0.02, 1.0));
  ASSERT_TRUE(own) << own.error().message();
  EXPECT_FALSE(own->interrupted);
  EXPECT_EQ(artefacts(), expected(200));
  EXPECT_EQ(records(), 200U);
}

// Whoever ended by itself, or was stopped, has no note any more: nobody waits for its lease.
TEST_F(Pullers, WhatAStoppedOneHadIsTakenAtOnce) {
  std::atomic<bool> stop = false;
  EngineSettings first = pulling(1, 0.02, 1000.0);
  first.stop = &stop;
  TellingCases cases(300, 1ms, [&](std::size_t computed) {
    if (computed == 50) stop = true;
  });
  const auto stopped = run_cases(cases, first);
  ASSERT_TRUE(stopped) << stopped.error().message();
  EXPECT_TRUE(stopped->interrupted);
  const auto rest = run_cases(cases, pulling(2, 0.02, 1000.0));
  ASSERT_TRUE(rest) << rest.error().message();
  EXPECT_FALSE(rest->interrupted);
  EXPECT_EQ(artefacts(), expected(300));
}

// The lease is told by whether a note changes, not by anybody's clock.
TEST_F(Pullers, AClockThatJumpsNeitherFreesNorHoldsAPack) {
  const pid_t child = ::fork();
  if (child == 0) {
    ToyCases cases(40, 20ms);
    static_cast<void>(run_cases(cases, pulling(1, 1000.0)));
    ::_exit(0);
  }
  std::jthread jumps([&](const std::stop_token& stop) {
    using Time = std::filesystem::file_time_type;
    for (int k = 0; !stop.stop_requested(); ++k) {
      std::error_code ignored;
      const auto to = Time::clock::now() + (k % 2 == 0 ? 9999h : -9999h);
      for (const auto& entry :
           std::filesystem::directory_iterator(folder_.path() / "journals", ignored)) {
        std::filesystem::last_write_time(entry.path(), to, ignored);
      }
      std::this_thread::sleep_for(5ms);
    }
  });
  EXPECT_TRUE(eventually([&] { return records() > 0; }));
  ToyCases cases(40);
  const auto own = run_cases(cases, pulling(2));
  int status = 0;
  ::waitpid(child, &status, 0);
  jumps.request_stop();
  ASSERT_TRUE(own) << own.error().message();
  EXPECT_EQ(artefacts(), expected(40));
  EXPECT_EQ(records(), 40U) << "none twice";
}

TEST_F(Pullers, ClaimsAreFewAndGoWithTheStudy) {
  ToyCases cases(100'000, {}, false);
  for (const std::size_t index : {1U, 2U}) {
    ASSERT_TRUE(run_cases(cases, pulling(index, 0.001)));
  }
  std::size_t files = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(folder_.path() / "claims")) {
    files += entry.is_regular_file() ? 1 : 0;
  }
  EXPECT_LE(files, 2200U);
  const auto whole = run_cases(cases, settings());
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->computed, 0U);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "claims"));
}

/// Cases that do what no case should.
class WildCases : public ToyCases {
 public:
  WildCases() : ToyCases(8, {}, false) {}
  CaseResult compute(std::size_t number) override {
    if (number == 1) std::this_thread::sleep_for(60s);
    if (number == 3) {
      std::vector<std::string> much;
      while (true) much.emplace_back(10'000'000, 'x');
    }
    if (number == 5) ::raise(SIGSEGV);
    if (number == 6) throw std::runtime_error("thrown");
    return ToyCases::compute(number);
  }
};

TEST_F(Engine, ACaseBeyondItsLimitsFailsAndTheOthersDoNot) {
  WildCases cases;
  EngineSettings with = settings(2);
  with.limits = {5.0, 500.0};
  const auto summary = run_cases(cases, with);
  ASSERT_TRUE(summary) << summary.error().message();
  EXPECT_EQ(summary->computed, 8U);
  ASSERT_EQ(summary->failures.size(), 4U);
  EXPECT_NE(summary->failures[0].find("longer than 5 s"), std::string::npos);
#ifndef FLEXSPLINE_SANITIZED  // which ends a process itself, by exit, in either case
  EXPECT_NE(summary->failures[1].find("more than 500 MB"), std::string::npos)
      << summary->failures[1];
  EXPECT_NE(summary->failures[2].find("signal 11"), std::string::npos);
#endif
  EXPECT_NE(summary->failures[3].find("thrown"), std::string::npos);
  const auto found = artefacts();
  EXPECT_EQ(found.size(), 8U);
  EXPECT_EQ(found.at("toy--0000007--r0"), ToyCases::artefact(7));
}

}  // namespace
}  // namespace flexspline::studies
