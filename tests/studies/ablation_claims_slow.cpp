// What docs/fits.md says of studies/ablation.toml, computed again.
#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "claims/claims.hpp"
#include "flexspline/data/artefact.hpp"
#include "flexspline/studies/run.hpp"
#include "source_dir.hpp"
#include "stored.hpp"
#include "study_file.hpp"

namespace flexspline::studies {
namespace {

/// Quantile by linear interpolation of the order statistics.
double quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  const double at = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const auto above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], at - static_cast<double>(below));
}

/// Errors of g^-1 by input, estimator and replicate.
class DampingErrors {
 public:
  DampingErrors(const std::filesystem::path& folder, const StudyPlan& plan) {
    for (std::size_t i = 0; i < plan.size(); ++i) {
      const CasePlan one = plan.at(i);
      const auto artefact = stored_artefact(folder, one.key);
      errors_[one.input->id][one.estimator->id].push_back(
          artefact.at("function_errors_percent").at("g_inverse"));
    }
  }

  /// Quartiles over the inputs of the median ratio over the replicates. The extremes are
  /// those of single fits whose knots the last digits of another processor choose otherwise.
  std::vector<claims::Number> gains(const std::string& from, const std::string& to) const {
    std::vector<double> all;
    for (const auto& [input, by_estimator] : errors_) {
      const auto& before = by_estimator.at(from);
      const auto& after = by_estimator.at(to);
      std::vector<double> ratios;
      for (std::size_t r = 0; r < before.size(); ++r) ratios.push_back(before[r] / after[r]);
      all.push_back(quantile(ratios, 0.5));
    }
    return {{"lower quartile", quantile(all, 0.25)}, {"upper quartile", quantile(all, 0.75)}};
  }

 private:
  std::map<std::string, std::map<std::string, std::vector<double>>> errors_;
};

TEST(Ablation, GainsWhatThePageSays) {
  const ScratchFolder folder;
  const auto study = load_study(std::string(FLEXSPLINE_SOURCE_DIR) + "/studies/ablation.toml");
  ASSERT_TRUE(study) << study.error().message();
  const auto plan = plan_study(*study, "test");
  ASSERT_TRUE(plan) << plan.error().message();
  RunSettings settings;
  settings.folder = folder.path();
  settings.jobs = 2;
  settings.build_id = "test";
  const auto summary = run_study(*plan, settings);
  ASSERT_TRUE(summary) << summary.error().message();
  ASSERT_TRUE(summary->failed.empty());
  const DampingErrors errors(folder.path(), *plan);
  claims::expect("docs/fits.md", "ablation-knots", errors.gains("static_even", "static"));
  claims::expect("docs/fits.md", "ablation-simulation", errors.gains("static", "trajectory"));
}

}  // namespace
}  // namespace flexspline::studies
