#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "flexspline/core/case_store.hpp"
#include "flexspline/data/artefact.hpp"
#include "flexspline/data/commitment.hpp"
#include "study_file.hpp"
#include "trial_fixture.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;
using testing::HasSubstr;

TrialConfig small_trial(int cases) {
  TrialConfig trial;
  trial.name = "small";
  trial.title = "small";
  trial.seed = 11;
  trial.rigs = {Rig::locked};
  trial.cases = cases;
  trial.draw = {.none = 1, .one = 1, .two = 0, .unknown = 0, .effects = {}};
  return trial;
}

class RunTrial : public testing::Test {
 protected:
  Result<TrialSummary> run(const TrialConfig& trial, const Diagnose& diagnose,
                           const std::atomic<bool>* stop = nullptr) {
    TrialSettings settings;
    settings.run.folder = folder_.path() / "out";
    settings.run.jobs = 2;
    settings.run.build_id = build_;
    settings.run.stop = stop;
    settings.diagnosis = {{"engine", "of this test"}};
    return run_trial(trial, settings, diagnose);
  }
  /// Says of all recordings that nothing was left out, and counts how often it was asked.
  Diagnose nothing_left_out() {
    return [this](const RecordingSet&, const DiagnosisProgress&) -> Result<Diagnosis> {
      ++asked_;
      return diagnosis_with(Verdict::adequate, {});
    };
  }
  static std::string key(int k) { return "case-000" + std::to_string(k); }
  std::string text(int k) const {
    const auto store = CaseStore::open(folder_.path() / "out");
    const auto one = store ? store->read(key(k)) : tl::unexpected(store.error());
    EXPECT_TRUE(one) << one.error().message();
    return one ? one->artefact : "";
  }
  ordered_json artefact(int k) const {
    return data::parse_artefact(text(k), key(k), kTrialCaseSchema).value_or(ordered_json{});
  }

  ScratchFolder folder_;
  std::atomic<int> asked_ = 0;
  std::string build_ = "build";
};

TEST_F(RunTrial, GivesTheDiagnosisNothingButRecordings) {
  std::mutex mutex;
  std::set<std::string> names;
  const auto summary = run(small_trial(3), [&](const RecordingSet& set, const auto&) {
    const std::scoped_lock lock(mutex);
    names.insert(set.name + set.note);
    return Result<Diagnosis>(diagnosis_with(Verdict::adequate, {}));
  });
  ASSERT_TRUE(summary.has_value()) << summary.error().message();
  EXPECT_EQ(names, std::set<std::string>{"case"});
}

TEST_F(RunTrial, ScoresWhatItUnsealsAndKeepsTheProof) {
  const auto summary = run(small_trial(4), nothing_left_out());
  ASSERT_TRUE(summary.has_value()) << summary.error().message();
  EXPECT_EQ(summary->run.computed, 4U);
  const auto scores = score_trial(summary->cases);
  EXPECT_EQ(scores.counter("null"), 2);
  EXPECT_EQ(scores.counter("null_ok"), 2);
  EXPECT_EQ(scores.counter("single"), 2);
  EXPECT_EQ(scores.counter("single_top"), 0);
  for (int k = 0; k < 4; ++k) {
    const ordered_json one = artefact(k);
    EXPECT_TRUE(data::unseal(one.at("commitment"), one.at("sealed")).has_value());
    const auto open = data::read_artefact(
        folder_.path() / "out" / "commitments" / (key(k) + ".json"), data::kCommitmentSchema);
    ASSERT_TRUE(open.has_value());
    EXPECT_EQ(*open, one.at("commitment"));
  }
}

TEST_F(RunTrial, OfADiagnosisWithoutFaultIsWithoutFault) {
  TrialConfig trial = small_trial(12);
  trial.rigs = {Rig::locked, Rig::free};
  trial.draw = {.none = 1, .one = 1, .two = 1, .unknown = 1, .effects = {}};
  std::map<std::string, ConcealedAnswer> answers;
  for (const TrialCase& one : plan_trial(trial)) {
    const auto made = conceal(one.plan);
    if (made) answers[made->recordings.sha256] = made->answer;
  }
  const auto summary = run(trial, [&](const RecordingSet& set, const auto&) {
    return Result<Diagnosis>(right_diagnosis(answers.at(set.sha256)));
  });
  ASSERT_TRUE(summary.has_value()) << summary.error().message();
  const auto scores = score_trial(summary->cases);
  for (const char* rate :
       {"null_ok", "single_top", "single_exact", "pair_all", "unknown_ok", "coord_ok"}) {
    EXPECT_EQ(scores.rate(rate).count, scores.rate(rate).of) << rate;
    EXPECT_GT(scores.rate(rate).of, 0) << rate;
  }
  EXPECT_EQ(scores.counter("false_names"), 0);
  EXPECT_NEAR(scores.median("holdout_after_over_best_median"), 1.0, 1e-12);
}

// Whoever computes them, however often it was killed or stopped: nothing of the run is in them.
TEST_F(RunTrial, GivesTheSameBytesWithAnyNumberOfWorkersAndShards) {
  ASSERT_TRUE(run(small_trial(6), nothing_left_out()).has_value());
  std::vector<std::string> once;
  for (int k = 0; k < 6; ++k) once.push_back(text(k));
  const std::string result = read_text(folder_.path() / "out" / "trial.json");
  std::filesystem::remove_all(folder_.path() / "out");
  for (const Shard shard : {Shard{2, 2}, Shard{1, 2}, Shard{}}) {
    TrialSettings settings;
    settings.run.folder = folder_.path() / "out";
    settings.run.jobs = shard.whole() ? 2 : 1;
    settings.run.build_id = build_;
    settings.run.shard = shard;
    settings.diagnosis = {{"engine", "of this test"}};
    ASSERT_TRUE(run_trial(small_trial(6), settings, nothing_left_out()).has_value());
  }
  for (int k = 0; k < 6; ++k) EXPECT_EQ(text(k), once[static_cast<std::size_t>(k)]);
  EXPECT_EQ(read_text(folder_.path() / "out" / "trial.json"), result);
  EXPECT_EQ(asked_, 12);
}

// What another diagnosis made of a case is no result of this one.
TEST_F(RunTrial, AnotherDiagnosisDoesNotTakeItsCasesOver) {
  ASSERT_TRUE(run(small_trial(2), nothing_left_out()).has_value());
  TrialSettings settings;
  settings.run.folder = folder_.path() / "out";
  settings.run.build_id = build_;
  settings.diagnosis = {{"engine", "another"}};
  EXPECT_EQ(run_trial(small_trial(2), settings, nothing_left_out())->run.computed, 2U);
}

TEST_F(RunTrial, ItsLockPlansTheSameTrial) {
  const auto file = folder_.write("t.toml",
                                  "schema = \"flexspline-trial/1\"\nname = \"t\"\nseed = 5\n"
                                  "rigs = [\"locked\"]\ncases = 3\n[draw]\none = 1\n");
  const auto trial = load_trial(file);
  ASSERT_TRUE(trial) << trial.error().message();
  ASSERT_TRUE(run(*trial, nothing_left_out()).has_value());
  const auto planned = plan_locked(folder_.path() / "out" / "study.lock.toml", {}, build_);
  ASSERT_TRUE(planned) << planned.error().message();
  EXPECT_EQ((*planned)->kind(), "trial");
  EXPECT_EQ((*planned)->size(), 3U);
  const auto done = (*planned)->done(folder_.path() / "out");
  ASSERT_TRUE(done) << done.error().message();
  EXPECT_EQ(done->reused, 3U);
}

TEST_F(RunTrial, RedoesNothingThatIsValid) {
  ASSERT_TRUE(run(small_trial(3), nothing_left_out()).has_value());
  const std::string first = read_text(folder_.path() / "out" / "trial.json");
  const auto again = run(small_trial(3), nothing_left_out());
  EXPECT_EQ(asked_, 3);
  EXPECT_EQ(again->run.reused, 3U);
  EXPECT_EQ(again->cases.size(), 3U) << "scores are of all cases";
  EXPECT_EQ(read_text(folder_.path() / "out" / "trial.json"), first);
}

TEST_F(RunTrial, GoesOnWithMoreCasesAndRedoesDamagedOnes) {
  ASSERT_TRUE(run(small_trial(3), nothing_left_out()).has_value());
  const auto journal = journals_in(folder_.path() / "out" / "journals").front();
  std::string damaged = read_text(journal);
  const auto at = damaged.find("\tcase-000");
  damaged[damaged.find("adequate", at)] = 'A';
  folder_.write("out/journals/" + journal.filename().string(), damaged);
  const auto more = run(small_trial(5), nothing_left_out());
  EXPECT_EQ(more->run.reused, 2U);
  EXPECT_EQ(more->run.computed, 3U);
  build_ = "another build";
  EXPECT_EQ(run(small_trial(5), nothing_left_out())->run.reused, 0U);
}

TEST_F(RunTrial, SetsCasesAsideThatItHasNoMore) {
  ASSERT_TRUE(run(small_trial(3), nothing_left_out()).has_value());
  EXPECT_EQ(run(small_trial(2), nothing_left_out())->cases.size(), 2U);
  const auto store = CaseStore::open(folder_.path() / "out");
  EXPECT_EQ(store->size(), 2U);
}

TEST_F(RunTrial, StopsAfterTheCaseAtHandAndGoesOnFromThere) {
  std::atomic<bool> stop = false;
  const auto interrupted = run(
      small_trial(6),
      [&](const RecordingSet&, const auto&) {
        stop = true;
        return Result<Diagnosis>(diagnosis_with(Verdict::adequate, {}));
      },
      &stop);
  ASSERT_TRUE(interrupted.has_value());
  EXPECT_TRUE(interrupted->run.interrupted);
  EXPECT_FALSE(exists(folder_.path() / "out" / "trial.json")) << "no scores of half a trial";
  const auto done = run(small_trial(6), nothing_left_out());
  EXPECT_FALSE(done->run.interrupted);
  EXPECT_EQ(done->run.reused, interrupted->run.computed);
  EXPECT_EQ(done->cases.size(), 6U);
}

TEST_F(RunTrial, KeepsFailuresAsFailuresAndTheRestGoesOn) {
  const auto summary = run(small_trial(4), [&](const RecordingSet&, const auto&) {
    const int asked = ++asked_;
    if (asked == 2) throw std::runtime_error("thrown");
    if (asked == 3) return Result<Diagnosis>(failure(ErrorCode::numerics, "diverged"));
    return Result<Diagnosis>(diagnosis_with(Verdict::adequate, {}));
  });
  ASSERT_TRUE(summary.has_value()) << summary.error().message();
  EXPECT_EQ(score_trial(summary->cases).counter("failed"), 2);
  ASSERT_EQ(summary->run.failed.size(), 2U);
  EXPECT_THAT(summary->run.failed[0] + summary->run.failed[1], HasSubstr("thrown"));
  EXPECT_THAT(summary->run.failed[0] + summary->run.failed[1], HasSubstr("diverged"));
}

TEST_F(RunTrial, FailsADiagnosisThatTakesTooLong) {
  TrialConfig trial = small_trial(1);
  trial.time_limit = 1e-9;
  const auto summary = run(trial, nothing_left_out());
  ASSERT_EQ(summary->run.failed.size(), 1U);
  EXPECT_THAT(summary->run.failed[0], HasSubstr("are allowed"));
}

TEST_F(RunTrial, WritesTablesAndAResultOfItsSchema) {
  ASSERT_TRUE(run(small_trial(4), nothing_left_out()).has_value());
  const auto out = folder_.path() / "out";
  const auto result = data::read_artefact(out / "trial.json", kTrialResultSchema);
  ASSERT_TRUE(result.has_value()) << result.error().message();
  EXPECT_EQ(result->at("scores").at("null_ok"), 2);
  EXPECT_EQ(result->at("scores").at("rates").at("null_ok").at("of"), 2);
  EXPECT_EQ(result->at("cases").size(), 4U);
  int counted = 0;
  for (const auto& cell : result->at("confusion")) counted += cell.at("count").get<int>();
  EXPECT_EQ(counted, 4) << "every case is in one cell";
  for (const char* name : {"scores", "rates", "confusion", "by_size", "by_effect", "cases"}) {
    EXPECT_TRUE(exists(out / "tables" / (std::string(name) + ".md"))) << name;
    EXPECT_TRUE(exists(out / "tables" / (std::string(name) + ".csv"))) << name;
  }
  EXPECT_THAT(read_text(out / "tables" / "confusion.csv"), HasSubstr("nothing,2"));
}

TEST(PlanOfATrial, DoesNotDependOnHowManyCasesThereAre) {
  const auto few = plan_trial(small_trial(10));
  const auto many = plan_trial(small_trial(40));
  for (std::size_t k = 0; k < few.size(); ++k) {
    EXPECT_EQ(few[k].plan.seed, many[k].plan.seed);
    ASSERT_EQ(few[k].plan.effects.size(), many[k].plan.effects.size());
    for (std::size_t i = 0; i < few[k].plan.effects.size(); ++i) {
      EXPECT_EQ(few[k].plan.effects[i].id, many[k].plan.effects[i].id);
    }
  }
}

std::string kind_of(const ConcealPlan& plan) {
  if (plan.effects.empty()) return "none";
  const std::string& id = plan.effects.front().id;
  if (id.starts_with("unknown:")) return "unknown";
  if (plan.effects.size() == 2) return "two";
  return testing::Matches(testing::Contains(id))(contained_on(plan.rig)) ? "contained" : "one";
}

TEST(PlanOfATrial, HasItsSharesAndTriesEveryEffect) {
  TrialConfig trial = small_trial(400);
  trial.rigs = {Rig::locked, Rig::free};
  trial.draw = {
      .none = 0.2, .one = 0.4, .two = 0.15, .unknown = 0.1, .contained = 0.15, .effects = {}};
  std::map<std::string, int> counts;
  std::map<std::pair<data::BenchKind, std::string>, int> singles;
  for (const TrialCase& one : plan_trial(trial)) {
    const auto& effects = one.plan.effects;
    ++counts[kind_of(one.plan)];
    if (effects.size() == 1) ++singles[{one.plan.rig, effects[0].id}];
    for (const auto& effect : effects) {
      EXPECT_GE(effect.size_fraction, trial.draw.smallest);
      EXPECT_LE(effect.size_fraction, trial.draw.largest);
    }
  }
  EXPECT_NEAR(counts["none"], 80, 4);
  EXPECT_NEAR(counts["one"], 160, 4);
  EXPECT_NEAR(counts["two"], 60, 4);
  EXPECT_NEAR(counts["unknown"], 40, 4);
  EXPECT_NEAR(counts["contained"], 60, 4);
  for (const data::BenchKind rig : trial.rigs) {
    for (const std::string& id : concealable(rig, data::HiddenClass::named)) {
      EXPECT_GE((singles[{rig, id}]), 3) << id;
    }
  }
}

TEST(PlanOfATrial, PairsNoStructuralTwins) {
  TrialConfig trial = small_trial(300);
  trial.draw = {.none = 0, .one = 0, .two = 1, .unknown = 0, .effects = {}};
  for (const TrialCase& one : plan_trial(trial)) {
    const auto& effects = one.plan.effects;
    ASSERT_EQ(effects.size(), 2U);
    for (const auto& effect : effects) {
      EXPECT_THAT(contained_on(one.plan.rig), testing::Not(testing::Contains(effect.id)));
    }
    EXPECT_NE(effects[0].id, effects[1].id);
    EXPECT_THAT(twins_of(effects[0].id, Rig::locked),
                testing::Not(testing::Contains(effects[1].id)));
  }
}

TEST(PlanOfATrial, DrawsWhatABaselineContainsWhereItIsListed) {
  TrialConfig trial = small_trial(8);
  trial.draw = {.none = 0, .one = 1, .two = 0, .unknown = 0, .effects = {"soft_windup"}};
  for (const TrialCase& one : plan_trial(trial)) {
    EXPECT_EQ(one.plan.effects.front().id, "soft_windup");
  }
}

}  // namespace
}  // namespace flexspline::studies
