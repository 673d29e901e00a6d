#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "conceal/lot.hpp"
#include "flexspline/data/artefact.hpp"
#include "flexspline/data/checksum.hpp"
#include "flexspline/data/commitment.hpp"
#include "run/study_folder.hpp"
#include "run/worker_pool.hpp"
#include "trial/trial_json.hpp"

namespace flexspline::studies {
namespace {

using Clock = std::chrono::steady_clock;
using nlohmann::ordered_json;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// What became of the diagnosis of a case.
struct Attempt {
  Result<Diagnosis> diagnosis;
  double seconds = 0.0;
};

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
  std::string depends_on(const TrialCase& one) const;
  void plan_cases();
  bool run_case(const TrialCase& one);
  Result<ordered_json> compute(const TrialCase& one);
  Result<ConcealedCase> conceal_case(const TrialCase& one) const;
  Result<std::string> salt_of(const TrialCase& one) const;
  Attempt diagnose_case(const RecordingSet& recordings) const;
  Result<void> score(const ordered_json& commitment, const Attempt& attempt,
                     ordered_json& artefact) const;
  void finish_case(const std::string& key, const Result<ordered_json>& artefact);
  void gather();

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

std::string TrialRun::depends_on(const TrialCase& one) const {
  ordered_json what = {{"build", settings_.run.build_id},
                       {"rig", name_of(one.plan.rig)},
                       {"seed", one.plan.seed},
                       {"time_limit", trial_.time_limit},
                       {"nuisances", one.plan.nuisances}};
  for (const data::HiddenEffect& effect : one.plan.effects) {
    what["effects"].push_back({effect.id, effect.size_fraction});
  }
  return data::sha256_hex(what.dump());
}

void TrialRun::plan_cases() {
  std::set<std::string> kept;
  summary_.run.cases = cases_.size();
  for (const TrialCase& one : cases_) {
    kept.insert(one.key + ".json");
    if (find_valid(file_of(one), kTrialCaseSchema, depends_on(one))) {
      ++summary_.run.reused;
      continue;
    }
    tasks_.emplace_back([this, &one] { return run_case(one); });
  }
  set_aside(folder() / "cases", kept, settings_.run);
}

/// The bench may not bring an effect to the drawn size; then another bench tries.
Result<ConcealedCase> TrialRun::conceal_case(const TrialCase& one) const {
  constexpr std::uint64_t kBenches = 8;
  ConcealPlan plan = one.plan;
  for (std::uint64_t attempt = 1;; ++attempt) {
    auto concealed = conceal(plan);
    const bool unreachable = !concealed && concealed.error().code == ErrorCode::usage;
    if (!unreachable || attempt == kBenches) return concealed;
    plan.seed = lot_bits(one.plan.seed, "other bench", attempt);
  }
}

Result<std::string> TrialRun::salt_of(const TrialCase& one) const {
  if (settings_.salt.empty()) return data::fresh_salt();
  return data::sha256_hex(settings_.salt + one.key);
}

Attempt TrialRun::diagnose_case(const RecordingSet& recordings) const {
  const Clock::time_point start = Clock::now();
  Attempt attempt{failure(ErrorCode::defect, "no diagnosis"), 0.0};
  try {
    attempt.diagnosis = diagnose_(recordings, {});
  } catch (const std::exception& error) {
    attempt.diagnosis = failure(ErrorCode::defect, error.what());
  }
  attempt.seconds = seconds_since(start);
  if (attempt.seconds > trial_.time_limit) {
    attempt.diagnosis =
        failure(ErrorCode::numerics, fmt::format("it took {:.1f} s, where {:.1f} s are allowed",
                                                 attempt.seconds, trial_.time_limit));
  }
  return attempt;
}

/// Only what the seal proves to be the answer of before the diagnosis is scored.
Result<void> TrialRun::score(const ordered_json& commitment, const Attempt& attempt,
                             ordered_json& artefact) const {
  const auto unsealed = data::unseal(commitment, artefact["sealed"]);
  if (!unsealed) return tl::unexpected(unsealed.error());
  const auto answer = answer_from_json(*unsealed);
  if (!answer) return tl::unexpected(answer.error());
  const Diagnosis* diagnosis = attempt.diagnosis ? &*attempt.diagnosis : nullptr;
  if (diagnosis != nullptr) artefact["diagnosis"] = excerpt_of(*diagnosis);
  if (diagnosis == nullptr) artefact["failure"] = attempt.diagnosis.error().message();
  artefact["score"] = to_json(score_case(*answer, diagnosis));
  artefact["seconds"] = attempt.seconds;
  return {};
}

Result<ordered_json> TrialRun::compute(const TrialCase& one) {
  ordered_json artefact = {
      {"schema", kTrialCaseSchema}, {"key", one.key},       {"depends_on", depends_on(one)},
      {"status", "done"},           {"failure", nullptr},   {"commitment", nullptr},
      {"sealed", nullptr},          {"diagnosis", nullptr}, {"score", nullptr},
      {"seconds", nullptr}};
  const auto concealed = conceal_case(one);
  if (!concealed) {
    artefact["status"] = "not concealed";
    artefact["failure"] = concealed.error().message();
    return artefact;
  }
  const auto salt = salt_of(one);
  if (!salt) return tl::unexpected(salt.error());
  const ordered_json answer = to_json(concealed->answer);
  artefact["commitment"] =
      data::commitment_to(answer, *salt, fmt::format("what was concealed in {}", one.key));
  const auto open =
      data::write_artefact(folder() / "commitments" / (one.key + ".json"), artefact["commitment"]);
  if (!open) return tl::unexpected(open.error());
  if (!settings_.recordings.empty()) {
    const auto kept = data::write_dataset(settings_.recordings / one.key, concealed->recordings);
    if (!kept) return tl::unexpected(kept.error());
  }
  artefact["sealed"] = data::sealed(answer, *salt);
  const auto scored = score(artefact["commitment"], diagnose_case(concealed->recordings), artefact);
  if (!scored) return tl::unexpected(scored.error());
  return artefact;
}

bool TrialRun::run_case(const TrialCase& one) {
  auto artefact = compute(one);
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
  run.progress({summary_.run.computed + summary_.run.reused, cases_.size(),
                summary_.run.failed.size(), seconds_since(start_)});
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
  summary_.run.seconds = seconds_since(start_);
  if (summary_.run.interrupted) return summary_;
  const auto written = data::write_artefact(folder() / "trial.json", trial_json(trial_, summary_));
  if (!written) return tl::unexpected(written.error());
  const auto tables = write_trial_tables(summary_, folder() / "tables");
  if (!tables) return tl::unexpected(tables.error());
  return summary_;
}

}  // namespace

Result<TrialSummary> run_trial(const TrialConfig& trial, const TrialSettings& settings,
                               const Diagnose& diagnose) {
  return TrialRun(trial, settings, diagnose)();
}

}  // namespace flexspline::studies
