#include "trial/compute_trial_case.hpp"

#include <chrono>
#include <exception>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "conceal/lot.hpp"
#include "flexspline/data/artefact.hpp"
#include "flexspline/data/checksum.hpp"
#include "flexspline/data/commitment.hpp"
#include "trial/effect_trace.hpp"
#include "trial/trial_json.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

/// What became of the diagnosis of a case.
struct Attempt {
  Result<Diagnosis> diagnosis;
  double seconds = 0.0;
};

/// The bench may not bring an effect to the drawn size; then the plan gets another bench.
Result<ConcealedCase> conceal_case(ConcealPlan& plan) {
  constexpr std::uint64_t kBenches = 8;
  const std::uint64_t seed = plan.seed;
  for (std::uint64_t attempt = 1;; ++attempt) {
    auto concealed = conceal(plan);
    const bool unreachable = !concealed && concealed.error().code == ErrorCode::usage;
    const bool drawn = plan.generator == "bench";  // others draw no other drive for an effect
    if (!unreachable || !drawn || attempt == kBenches) return concealed;
    plan.seed = lot_bits(seed, "other bench", attempt);
  }
}

/// Not known where the baseline cannot be fitted.
std::vector<EffectTrace> known_traces(const ConcealPlan& plan, const RecordingSet& recordings) {
  auto traces = traces_of(plan, recordings);
  if (traces) return *std::move(traces);
  std::vector<EffectTrace> unknown;
  for (const data::HiddenEffect& effect : plan.effects) unknown.push_back({.effect = effect.id});
  return unknown;
}

/// Who has the trial's seed can draw its cases anyway; so a case is the same whenever it is run.
std::string salt_of(const TrialConfig& trial, const TrialCase& one) {
  return data::sha256_hex(fmt::format("salt {} {} {}", trial.name, trial.seed, one.key));
}

Attempt diagnose_case(const RecordingSet& recordings, double time_limit, const Diagnose& diagnose) {
  const auto start = std::chrono::steady_clock::now();
  Attempt attempt{failure(ErrorCode::defect, "no diagnosis"), 0.0};
  try {
    attempt.diagnosis = diagnose(recordings, {});
  } catch (const std::exception& error) {
    attempt.diagnosis = failure(ErrorCode::defect, error.what());
  }
  attempt.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (attempt.seconds > time_limit) {
    attempt.diagnosis =
        failure(ErrorCode::numerics,
                fmt::format("it took longer than the {:.3g} s that are allowed", time_limit));
  }
  return attempt;
}

/// A diagnosis is scored by nothing but what the seal proves to be the answer of before it.
Result<void> score(const Attempt& attempt, ordered_json& artefact) {
  const auto unsealed = data::unseal(artefact["commitment"], artefact["sealed"]);
  if (!unsealed) return tl::unexpected(unsealed.error());
  const auto answer = answer_from_json(*unsealed);
  if (!answer) return tl::unexpected(answer.error());
  const Diagnosis* diagnosis = attempt.diagnosis ? &*attempt.diagnosis : nullptr;
  if (diagnosis != nullptr) artefact["diagnosis"] = excerpt_of(*diagnosis);
  if (diagnosis == nullptr) artefact["failure"] = attempt.diagnosis.error().message();
  artefact["score"] = to_json(score_case(*answer, diagnosis));
  return {};
}

/// Seals the answer in the artefact, and shows the commitment before anyone is asked.
Result<void> commit(const TrialConfig& trial, const TrialCase& one,
                    const ConcealedAnswer& concealed, const TrialSettings& settings,
                    ordered_json& artefact) {
  const std::string salt = salt_of(trial, one);
  const ordered_json answer = to_json(concealed);
  artefact["sealed"] = data::sealed(answer, salt);
  artefact["commitment"] =
      data::commitment_to(answer, salt, fmt::format("what was concealed in {}", one.key));
  if (settings.run.folder.empty()) return {};
  return data::write_artefact(settings.run.folder / "commitments" / (one.key + ".json"),
                              artefact["commitment"]);
}

ordered_json empty_artefact(const TrialCase& one, const std::string& depends_on) {
  ordered_json artefact = {{"schema", kTrialCaseSchema},
                           {"key", one.key},
                           {"depends_on", depends_on},
                           {"status", "done"}};
  for (const char* key : {"failure", "commitment", "sealed", "diagnosis", "score", "trace"}) {
    artefact[key] = nullptr;
  }
  return artefact;
}

}  // namespace

std::string dependencies_of(const TrialConfig& trial, const TrialCase& one,
                            const TrialSettings& settings) {
  ordered_json what = {{"build", settings.run.build_id},  {"diagnosis", settings.diagnosis},
                       {"salt", salt_of(trial, one)},     {"rig", name_of(one.plan.rig)},
                       {"seed", one.plan.seed},           {"time_limit", trial.time_limit},
                       {"nuisances", one.plan.nuisances}, {"disturbances", one.plan.disturbances},
                       {"generator", one.plan.generator}, {"source", one.plan.source.string()},
                       {"change", one.plan.change}};
  for (const data::HiddenEffect& effect : one.plan.effects) {
    what["effects"].push_back({effect.id, effect.size_fraction});
  }
  return data::sha256_hex(what.dump());
}

Result<TrialCaseResult> compute_trial_case(const TrialConfig& trial, const TrialCase& one,
                                           const TrialSettings& settings,
                                           const Diagnose& diagnose) {
  TrialCaseResult result{empty_artefact(one, dependencies_of(trial, one, settings)), 0.0};
  ordered_json& artefact = result.artefact;
  ConcealPlan plan = one.plan;
  const auto concealed = conceal_case(plan);
  if (!concealed) {
    artefact["status"] = "not concealed";
    artefact["failure"] = concealed.error().message();
    return result;
  }
  const auto committed = commit(trial, one, concealed->answer, settings, artefact);
  if (!committed) return tl::unexpected(committed.error());
  if (!settings.recordings.empty()) {
    const auto kept = data::write_dataset(settings.recordings / one.key, concealed->recordings);
    if (!kept) return tl::unexpected(kept.error());
  }
  const Attempt attempt = diagnose_case(concealed->recordings, trial.time_limit, diagnose);
  result.seconds = attempt.seconds;
  const auto scored = score(attempt, artefact);
  if (!scored) return tl::unexpected(scored.error());
  artefact["trace"] = to_json(known_traces(plan, concealed->recordings));
  return result;
}

}  // namespace flexspline::studies
