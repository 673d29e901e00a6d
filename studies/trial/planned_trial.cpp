#include <nlohmann/json.hpp>

#include "flexspline/core/write_file.hpp"
#include "trial/trial_cases.hpp"
#include "trial/trial_json.hpp"

namespace flexspline::studies {

using nlohmann::ordered_json;

namespace {

class PlannedTrial : public PlannedStudy {
 public:
  PlannedTrial(TrialConfig trial, TrialSettings settings)
      : trial_(std::move(trial)),
        settings_(std::move(settings)),
        cases_(trial_, settings_, diagnose_) {}

  std::string name() const override { return trial_.name; }
  std::string kind() const override { return "trial"; }
  std::size_t size() const override { return cases_.size(); }
  std::filesystem::path file() const override { return trial_.file; }
  std::string text() const override { return read_file(trial_.file).value_or(""); }
  std::vector<std::filesystem::path> reads() const override { return trial_.spliced_sets; }
  ordered_json summary() const override { return {{"design", design_json(trial_)}}; }
  ordered_json case_summary(std::size_t number) const override {
    const TrialCase& one = cases_.at(number);
    return {{"key", one.key},
            {"generator", one.plan.generator},
            {"rig", name_of(one.plan.rig)},
            {"seed", one.plan.seed},
            {"depends_on", cases_.name(number).depends_on}};
  }
  Pilot pilot(double seconds) const override {
    TrialSettings nowhere = settings_;
    nowhere.run.folder.clear();
    nowhere.recordings.clear();
    const Diagnose diagnose = diagnose_as(settings_.diagnosis, 0);
    TrialCases cases(trial_, nowhere, diagnose);
    return measure_cases(cases, seconds);
  }
  Result<RunSummary> run(const RunSettings& settings) const override {
    TrialSettings own = settings_;
    own.run = settings;
    return run_trial_cases(trial_, own, diagnose_as(settings_.diagnosis, settings.jobs));
  }
  Result<RunSummary> done(const std::filesystem::path& folder) const override {
    return gather_trial(trial_, in(folder)).map([](const TrialSummary& one) { return one.run; });
  }
  Result<void> gather(const std::filesystem::path& folder, const RunSettings&,
                      bool) const override {
    const TrialSettings here = in(folder);
    const auto summary = gather_trial(trial_, here);
    if (!summary) return tl::unexpected(summary.error());
    return write_trial(trial_, *summary, here.run);
  }

 private:
  TrialSettings in(const std::filesystem::path& folder) const {
    TrialSettings here = settings_;
    here.run.folder = folder;
    return here;
  }

  TrialConfig trial_;
  TrialSettings settings_;
  Diagnose diagnose_{};  ///< of cases that are only named
  TrialCases cases_;
};

}  // namespace

PlannedStudyPtr plan_trial_study(TrialConfig trial, TrialSettings settings) {
  return std::make_unique<PlannedTrial>(std::move(trial), std::move(settings));
}

}  // namespace flexspline::studies
