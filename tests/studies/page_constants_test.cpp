// Defaults and limits that the pages print are those of the code.
#include <algorithm>
#include <regex>

#include <gtest/gtest.h>

#include "answers/profile_likelihood.hpp"
#include "claims/claims.hpp"
#include "comparison/decimate.hpp"
#include "flexspline/studies/engine.hpp"
#include "flexspline/studies/study_config.hpp"
#include "source_dir.hpp"
#include "study_file.hpp"

namespace flexspline::studies {
namespace {

namespace fs = std::filesystem;

/// A shipped study without some of its keys.
StudyConfig study_without(const std::string& name, const std::string& keys) {
  const fs::path folder = fs::path(FLEXSPLINE_SOURCE_DIR) / "studies";
  const ScratchFolder scratch;
  fs::create_directory_symlink(folder / "models", scratch.path() / "models");
  const std::regex line("\n(" + keys + ") = [^\n]*");
  const std::string text = std::regex_replace(read_text(folder / name), line, "");
  EXPECT_FALSE(std::regex_search(text, line));
  auto study = load_study(scratch.write("study.toml", text));
  EXPECT_TRUE(study) << study.error().message();
  return study ? *study : StudyConfig{};
}

double number(const StudyConfig& study, const std::string& name) {
  const auto found = study.settings.numbers.find(name);
  return found == study.settings.numbers.end() ? -1.0 : found->second;
}

double largest_set(const StudyConfig& study) {
  std::size_t most = 0;
  for (const Grid& grid : study.grids) {
    if (grid.id != study.settings.words.at("grid")) most = std::max(most, grid.loops.size());
  }
  return static_cast<double>(most);
}

TEST(PageConstants, DefaultsOfTheKinds) {
  const char* page = "docs/study-kinds.md";
  const StudyConfig sets = study_without("generalisation.toml", "largest_set|error");
  claims::expect(page, "generalisation-defaults",
                 {{"largest_set", largest_set(sets)}, {"error", number(sets, "error_percent")}});
  const StudyConfig broken = study_without("robustness.toml", "error");
  claims::expect(page, "robustness-default", {{"error", number(broken, "error_percent")}});
  const StudyConfig coverage = study_without("coverage.toml", "ranks");
  claims::expect(page, "coverage-default", {{"ranks", number(coverage, "ranks")}});
  const StudyConfig sobol = study_without("sensitivity.toml", "samples");
  claims::expect(page, "sensitivity-default", {{"samples", number(sobol, "samples")}});
  const StudyConfig starts = study_without("multistart.toml", "starts");
  claims::expect(page, "multistart-starts",
                 {{"starts", static_cast<double>(starts.estimators.size())}});
  claims::expect(page, "multistart-same-cost", {{"same_cost", number(starts, "same_cost")}});
}

TEST(PageConstants, LimitsOfStudies) {
  claims::expect("docs/study-kinds.md", "profile-rise", {{"rise", kProfileRise}});
  claims::expect("docs/artefacts.md", "series-points", {{"points", double{kKeptPoints}}});
  claims::expect("docs/large-studies.md", "pack-seconds", {{"pack", Pulling().pack_seconds}});
  claims::expect("docs/large-studies.md", "lease-seconds", {{"lease", Pulling().lease_seconds}});
}

}  // namespace
}  // namespace flexspline::studies
