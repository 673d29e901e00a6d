#include <chrono>

#include <nlohmann/json.hpp>

#include "flexspline/core/case_store.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/data/artefact.hpp"
#include "flexspline/data/checksum.hpp"
#include "run/study_folder.hpp"
#include "trial/compute_trial_case.hpp"
#include "trial/trial_cases.hpp"
#include "trial/trial_json.hpp"

namespace flexspline::studies {
namespace {

using Clock = std::chrono::steady_clock;
using nlohmann::ordered_json;

Result<void> write_trial_lock(const TrialConfig& trial, const TrialSettings& settings,
                              const TrialCases& cases) {
  ordered_json study = design_json(trial);
  study.update({{"name", trial.name}, {"title", trial.title}, {"kind", "trial"}});
  ordered_json lock = lock_head(settings.run);
  lock["study"] = std::move(study);
  lock["diagnosis"] = settings.diagnosis;
  add_cases(cases, lock);
  if (const auto text = read_file(trial.file)) {
    lock["study_sha256"] = data::sha256_hex(*text);
    lock["source"] = {
        {"file", lasting(trial.file)}, {"data_root", lasting(trial.data_root)}, {"text", *text}};
  }
  return write_lock(settings.run.folder, lock);
}

/// Enters a case where it belongs.
Result<void> enter(const StoredCase& stored, TrialSummary& summary) {
  const auto artefact = data::parse_artefact(stored.artefact, stored.key, kTrialCaseSchema);
  if (!artefact) return tl::unexpected(artefact.error());
  if (artefact->at("status") == "not concealed") {
    summary.not_concealed.push_back(stored.key + ": " + artefact->at("failure").get<std::string>());
    return {};
  }
  auto scored = scored_case_from_json(*artefact);
  if (!scored) return tl::unexpected(scored.error());
  scored->seconds = stored.seconds;
  if (scored->score.failed) summary.run.failed.push_back(stored.key + ": " + scored->failure);
  summary.cases.push_back(*std::move(scored));
  return {};
}

}  // namespace

Result<RunSummary> run_trial_cases(const TrialConfig& trial, const TrialSettings& settings,
                                   const Diagnose& diagnose) {
  const Clock::time_point start = Clock::now();
  TrialCases cases(trial, settings, diagnose);
  if (const auto locked = write_trial_lock(trial, settings, cases); !locked) {
    return tl::unexpected(locked.error());
  }
  set_old_cases_aside(settings.run);
  auto ran = run_cases(cases, settings.run);
  if (!ran) return tl::unexpected(ran.error());
  RunSummary summary = summary_of(std::move(*ran));
  summary.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return summary;
}

Result<TrialSummary> gather_trial(const TrialConfig& trial, const TrialSettings& settings) {
  const auto store = CaseStore::open(settings.run.folder);
  if (!store) return tl::unexpected(store.error());
  TrialSummary summary;
  summary.run.cases = static_cast<std::size_t>(trial.cases);
  for (const TrialCase& planned : plan_trial(trial)) {
    const auto digest = CaseStore::digest_of(dependencies_of(trial, planned, settings));
    if (!store->contains(digest)) continue;  // not computed yet
    const auto one = store->read(digest);
    if (!one) return tl::unexpected(one.error());
    if (const auto entered = enter(*one, summary); !entered) {
      return tl::unexpected(in_context(entered.error(), planned.key));
    }
    ++summary.run.reused;
  }
  summary.run.failures = summary.run.failed.size() + summary.not_concealed.size();
  return summary;
}

Result<void> write_trial(const TrialConfig& trial, const TrialSummary& summary,
                         const RunSettings& settings) {
  const auto json = trial_json(trial, summary, settings.build_id);
  return data::write_artefact(settings.folder / "trial.json", json).and_then([&] {
    return write_trial_tables(summary, settings.folder / "tables");
  });
}

Result<TrialSummary> run_trial(const TrialConfig& trial, const TrialSettings& settings,
                               Diagnose diagnose) {
  if (!diagnose) diagnose = diagnose_as(settings.diagnosis, settings.run.jobs);
  const auto ran = run_trial_cases(trial, settings, diagnose);
  if (!ran) return tl::unexpected(ran.error());
  auto summary = gather_trial(trial, settings);
  if (!summary) return summary;
  const auto failed = std::move(summary->run.failed);
  summary->run = *ran;
  summary->run.failed = failed;
  if (summary->run.interrupted) return summary;
  if (const auto written = write_trial(trial, *summary, settings.run); !written) {
    return tl::unexpected(written.error());
  }
  return summary;
}

}  // namespace flexspline::studies
