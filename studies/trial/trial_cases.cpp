#include "trial/trial_cases.hpp"

#include <nlohmann/json.hpp>

#include "flexspline/data/artefact.hpp"
#include "trial/compute_trial_case.hpp"

namespace flexspline::studies {
namespace {

/// Why a case has no diagnosis; empty where it has one.
std::string failure_of(const nlohmann::ordered_json& artefact) {
  if (!artefact.at("failure").is_string()) return {};
  const std::string why = artefact.at("failure").get<std::string>();
  return artefact.at("status") == "done" ? why : "not concealed: " + why;
}

}  // namespace

CaseName TrialCases::name(std::size_t number) const {
  const TrialCase& one = cases_.at(number);
  return {one.key, dependencies_of(*trial_, one, *settings_)};
}

CaseResult TrialCases::result_of(std::size_t number, const Diagnose& diagnose) const {
  CaseResult result;
  auto computed = compute_trial_case(*trial_, cases_.at(number), *settings_, diagnose);
  if (!computed) {
    result.broken = in_context(computed.error(), cases_.at(number).key);
    return result;
  }
  result.failure = failure_of(computed->artefact);
  result.seconds = computed->seconds;
  result.row = "{}";
  result.artefact = data::sealed(std::move(computed->artefact));
  return result;
}

CaseResult TrialCases::compute(std::size_t number) { return result_of(number, *diagnose_); }

CaseResult TrialCases::give_up(std::size_t number, const Error& why) {
  return result_of(number, [&](const RecordingSet&, const DiagnosisProgress&) {
    return Result<Diagnosis>(tl::unexpected(why));
  });
}

}  // namespace flexspline::studies
