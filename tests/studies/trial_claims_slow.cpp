// The scores of blind trials that the pages print, computed again.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claims/claims.hpp"
#include "flexspline/studies/trial.hpp"
#include "source_dir.hpp"
#include "study_file.hpp"

namespace flexspline::studies {
namespace {

constexpr std::pair<const char*, const char*> kRows[] = {
    {"nothing missing: `adequate`, no name", "null_ok"},
    {"one effect: named, and nothing else", "single_exact"},
    {"one effect: named first", "single_top"},
    {"two effects: both named", "pair_all"},
    {"two effects: one at least", "pair_one"},
    {"outside the catalogue: said, without a name", "unknown_ok"},
    {"outside the catalogue: no name", "unknown_unnamed"},
    {"contained in the baseline: no other name", "contained_ok"},
    {"inside one recording: placed", "incident_ok"},
    {"the coordinate among the first three", "coord_ok"},
    {"cases with a false name", "false_name"},
};

std::string row_of(const char* label, const char* rate, const TrialScores& all,
                   const TrialScores& seen) {
  const Proportion one = all.rate(rate), visible = seen.rate(rate);
  if (one.of == 0) return "";
  return fmt::format("| {} | {} of {} | {:.0f} to {:.0f} % | {} of {} |\n", label, one.count,
                     one.of, 100.0 * one.lower, 100.0 * one.upper, visible.count, visible.of);
}

std::string table_of(const std::vector<ScoredCase>& cases) {
  const TrialScores all = score_trial(cases);
  const TrialScores seen = score_trial(that_can_be_seen(cases));
  std::string table =
      "\n| | cases | 95 % interval | of those that can be seen |\n|---|---|---|---|\n";
  for (const auto& [label, rate] : kRows) table += row_of(label, rate, all, seen);
  return table;
}

/// The first cases of a trial of studies/, none of which may fail.
std::vector<ScoredCase> scored(const std::string& name, int cases) {
  auto trial = load_trial(std::string(FLEXSPLINE_SOURCE_DIR) + "/studies/" + name);
  EXPECT_TRUE(trial) << trial.error().message();
  if (!trial) return {};
  trial->cases = cases;
  const ScratchFolder folder;
  TrialSettings settings;
  settings.run.folder = folder.path();
  settings.run.jobs = 2;
  settings.run.build_id = "test";
  const auto summary = run_trial(*trial, settings);
  EXPECT_TRUE(summary) << summary.error().message();
  if (!summary) return {};
  EXPECT_TRUE(summary->run.failed.empty());
  EXPECT_TRUE(summary->not_concealed.empty());
  return summary->cases;
}

TEST(TrialScores, OnTheVirtualBenchAreWhatThePageSays) {
  claims::expect_text("docs/diagnosis.md", "trial-scores", table_of(scored("trial.toml", 80)));
}

TEST(TrialScores, OnWidenedBenchesAreWhatThePageSays) {
  claims::expect_text("docs/trials.md", "wide-scores", table_of(scored("wide.toml", 40)));
}

}  // namespace
}  // namespace flexspline::studies
