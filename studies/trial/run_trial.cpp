#include <algorithm>
#include <chrono>
#include <mutex>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "flexspline/core/in_parallel.hpp"
#include "flexspline/data/artefact.hpp"
#include "run/study_folder.hpp"
#include "run/worker_pool.hpp"
#include "trial/compute_trial_case.hpp"
#include "trial/trial_json.hpp"

namespace flexspline::studies {
namespace {

using Clock = std::chrono::steady_clock;
using nlohmann::ordered_json;

class TrialRun {
 public:
  TrialRun(const TrialConfig& trial, const TrialSettings& settings, const Diagnose& diagnose)
      : trial_(trial), settings_(settings), diagnose_(diagnose), cases_(plan_trial(trial)) {}

  Result<TrialSummary> operator()();

 private:
  std::filesystem::path folder() const { return settings_.run.folder; }
  std::filesystem::path file_of(const TrialCase& one) const {
    return folder() / "cases" / (one.key + ".json");
  }
  void plan_cases();
  bool run_case(const TrialCase& one);
  void finish_case(const std::string& key, const Result<ordered_json>& artefact);
  void gather();
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  const TrialConfig& trial_;
  const TrialSettings& settings_;
  const Diagnose& diagnose_;
  std::vector<TrialCase> cases_;
  std::vector<std::function<bool()>> tasks_;
  std::mutex mutex_;
  TrialSummary summary_;
  std::optional<Error> error_;
  Clock::time_point start_ = Clock::now();
};

void TrialRun::plan_cases() {
  std::set<std::string> kept;
  summary_.run.cases = cases_.size();
  for (const TrialCase& one : cases_) {
    kept.insert(one.key + ".json");
    if (is_valid(file_of(one), kTrialCaseSchema,
                 dependencies_of(trial_, one, settings_.run.build_id))) {
      ++summary_.run.reused;
      continue;
    }
    tasks_.emplace_back([this, &one] { return run_case(one); });
  }
  set_aside(folder() / "cases", kept, settings_.run);
}

bool TrialRun::run_case(const TrialCase& one) {
  auto artefact = compute_trial_case(trial_, one, settings_, diagnose_);
  if (artefact) {
    const auto written = data::write_artefact(file_of(one), *artefact);
    if (!written) artefact = tl::unexpected(written.error());
  }
  finish_case(one.key, artefact);
  return artefact.has_value();
}

void TrialRun::finish_case(const std::string& key, const Result<ordered_json>& artefact) {
  const std::scoped_lock lock(mutex_);
  if (!artefact) {
    if (!error_) error_ = in_context(artefact.error(), key);
    return;
  }
  ++summary_.run.computed;
  const RunSettings& run = settings_.run;
  if ((*artefact)["failure"].is_string()) {
    const std::string says = key + ": " + (*artefact)["failure"].get<std::string>();
    summary_.run.failed.push_back(says);
    if (run.log) run.log(says);
  }
  if (!run.progress) return;
  run.progress({summary_.run.computed + summary_.run.reused,
                cases_.size(),
                summary_.run.failed.size(),
                seconds(),
                0.0,
                {},
                0.0});
}

/// Every case from its artefact, so that a run that computed nothing says the same.
void TrialRun::gather() {
  summary_.run.failed.clear();
  for (const TrialCase& one : cases_) {
    const auto artefact = data::read_artefact(file_of(one), kTrialCaseSchema);
    if (!artefact) continue;  // interrupted before it
    if (artefact->at("status") == "not concealed") {
      summary_.not_concealed.push_back(one.key + ": " + artefact->at("failure").get<std::string>());
      continue;
    }
    auto scored = scored_case_from_json(*artefact);
    if (!scored) continue;
    if (scored->score.failed) summary_.run.failed.push_back(one.key + ": " + scored->failure);
    summary_.cases.push_back(*std::move(scored));
  }
}

Result<TrialSummary> TrialRun::operator()() {
  plan_cases();
  const bool all = run_tasks(tasks_, settings_.run.jobs, settings_.run.stop);
  if (error_) return tl::unexpected(*error_);
  summary_.run.interrupted = !all;
  gather();
  summary_.run.failures = summary_.run.failed.size();
  summary_.run.seconds = seconds();
  if (summary_.run.interrupted) return summary_;
  const auto written = data::write_artefact(folder() / "trial.json",
                                            trial_json(trial_, summary_, settings_.run.build_id));
  if (!written) return tl::unexpected(written.error());
  const auto tables = write_trial_tables(summary_, folder() / "tables");
  if (!tables) return tl::unexpected(tables.error());
  return summary_;
}

// The processors shared out among the cases that are diagnosed at once.
Diagnose on_their_share(int jobs) {
  const auto found = static_cast<unsigned>(threads_for(0));
  const unsigned share = jobs > 0 ? found / static_cast<unsigned>(jobs) : 1U;
  return [threads = std::max(1U, share)](const RecordingSet& recordings,
                                         const DiagnosisProgress& progress) {
    return diagnose(recordings, progress, threads);
  };
}

}  // namespace

Result<TrialSummary> run_trial(const TrialConfig& trial, const TrialSettings& settings,
                               const Diagnose& diagnose) {
  if (diagnose) return TrialRun(trial, settings, diagnose)();
  return TrialRun(trial, settings, on_their_share(settings.run.jobs))();
}

}  // namespace flexspline::studies
