#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "config/study_source.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/studies/planned_study.hpp"
#include "flexspline/studies/results.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

ordered_json sweeps_json(const StudyConfig& study) {
  ordered_json list = ordered_json::array();
  for (const SweepAxis& sweep : study.sweeps) {
    std::vector<std::string> keys;
    for (const SweepKey& key : sweep.keys) keys.push_back(key.path);
    list.push_back({{"keys", keys}, {"points", sweep.points.size()}});
  }
  return list;
}

/// Estimators on inputs: every kind but the blind trial.
class PlannedFits : public PlannedStudy {
 public:
  PlannedFits(std::unique_ptr<const StudyConfig> study, StudyPlan plan)
      : study_(std::move(study)), plan_(std::move(plan)) {}

  std::string name() const override { return study_->name; }
  std::string kind() const override { return study_->kind; }
  std::size_t size() const override { return plan_.size(); }
  std::filesystem::path file() const override { return study_->file; }
  std::string text() const override { return study_->source ? study_->source->text : ""; }
  std::vector<std::filesystem::path> reads() const override {
    std::vector<std::filesystem::path> sets;
    for (const InputConfig& input : study_->inputs) {
      if (!input.dataset.empty()) sets.push_back(input.dataset);
    }
    return sets;
  }
  std::map<std::string, std::string> data() const override {
    std::map<std::string, std::string> sums;
    for (const auto& [id, set] : plan_.datasets) sums[id] = set.sha256;
    return sums;
  }
  std::map<std::string, std::string> notes() const override { return plan_.notes; }

  ordered_json summary() const override {
    return {{"unique_fits", plan_.unique_fits()},
            {"inputs", study_->inputs.size()},
            {"estimators", study_->estimators.size()},
            {"first_seed", study_->seed},
            {"replicates", study_->replicates},
            {"sweeps", sweeps_json(*study_)},
            {"split", plan_.notes}};
  }
  ordered_json case_summary(std::size_t number) const override {
    const CasePlan one = plan_.at(number);
    return {{"key", one.key},
            {"input", one.input->id},
            {"estimator", one.estimator->id},
            {"method", one.estimator->method},
            {"replicate", one.replicate},
            {"seed", one.seed},
            {"train", one.train},
            {"holdout", one.holdout},
            {"depends_on", one.depends_on}};
  }
  Pilot pilot(double seconds) const override { return measure_pilot(plan_, seconds); }

  Result<RunSummary> run(const RunSettings& settings) const override {
    return run_study(plan_, settings);
  }
  Result<RunSummary> done(const std::filesystem::path& folder) const override {
    const auto rows = StudyRows::open(plan_, folder);
    if (!rows) return tl::unexpected(rows.error());
    RunSummary summary;
    summary.cases = plan_.size();
    summary.reused = rows->done();
    summary.failures = rows->failed();
    return summary;
  }
  Result<void> gather(const std::filesystem::path& folder, const RunSettings& settings,
                      bool answers_alone) const override {
    const auto rows = StudyRows::open(plan_, folder);
    if (!rows) return tl::unexpected(rows.error());
    if (answers_alone) return write_answer(*rows, folder);
    return write_results(*rows, settings.versions, folder)
        .and_then([&] { return write_answer(*rows, folder); })
        .and_then([&] { return write_ro_crate(plan_, settings.versions, folder); });
  }

 private:
  std::unique_ptr<const StudyConfig> study_;
  StudyPlan plan_;  ///< points into it
};

}  // namespace

Result<PlannedStudyPtr> plan_fits(StudyConfig study, const std::string& build_id) {
  auto own = std::make_unique<const StudyConfig>(std::move(study));
  auto plan = plan_study(*own, build_id);
  if (!plan) return tl::unexpected(plan.error());
  return std::make_unique<PlannedFits>(std::move(own), std::move(*plan));
}

}  // namespace flexspline::studies
