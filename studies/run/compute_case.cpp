#include "run/compute_case.hpp"

#include <exception>

#include <fmt/format.h>

namespace flexspline::studies {
namespace {

CaseOutcome failed(Error error) { return {tl::unexpected(std::move(error)), {}}; }

/// The recording as the estimator gets it.
TorsionRecord training_record(const StudyRecording& recording, const EstimatorConfig& estimator) {
  TorsionRecord record = recording.record;
  if (!estimator.steady || !recording.truth || !record.frequency_hz) return record;
  const double steady_from = record.time.front() + 1.0 / *record.frequency_hz;
  for (std::size_t i = 0; i < record.time.size() && record.time[i] < steady_from; ++i) {
    record.valid[i] = false;
  }
  return record;
}

/// A fit that ended without a result is a failure, whatever numbers it left.
Result<Estimate> estimate_of(const CasePlan& plan, const PreparedInput& input) {
  const auto method = estimators::find_method(plan.estimator->method);
  if (!method) return tl::unexpected(method.error());
  estimators::FitProblem problem;
  problem.options = plan.estimator->options;
  for (const std::string& id : plan.train) {
    problem.records.push_back(training_record(*input.find(id), *plan.estimator));
  }
  Result<Estimate> estimate = (*method)->fit(problem);
  if (!estimate) return estimate;
  if (estimate->termination == Termination::not_run ||
      estimate->termination == Termination::failed) {
    return failure(
        ErrorCode::numerics,
        fmt::format("{} ended with '{}'", plan.estimator->method, name_of(estimate->termination)),
        estimate->notes.empty() ? "" : estimate->notes.front());
  }
  return estimate;
}

CaseOutcome compute(const CasePlan& plan, const PreparedInput& input) {
  CaseOutcome outcome{estimate_of(plan, input), {}};
  if (!outcome.estimate) return outcome;
  const auto compare = [&](const std::string& id, bool trained) -> Result<void> {
    auto comparison = compare_recording(*outcome.estimate, *input.find(id), trained);
    if (!comparison) return tl::unexpected(in_context(comparison.error(), "recording " + id));
    outcome.recordings.push_back(std::move(*comparison));
    return {};
  };
  for (const std::string& id : plan.train) {
    if (auto compared = compare(id, true); !compared) return failed(compared.error());
  }
  for (const std::string& id : plan.holdout) {
    if (auto compared = compare(id, false); !compared) return failed(compared.error());
  }
  return outcome;
}

}  // namespace

CaseOutcome compute_case(const CasePlan& plan, const Result<PreparedInput>& input) {
  if (!input) return failed(input.error());
  try {
    return compute(plan, *input);
  } catch (const std::exception& error) {
    return failed({ErrorCode::defect,
                   fmt::format("{}: {}", plan.key, error.what()),
                   "please report it with the study file",
                   {}});
  }
}

}  // namespace flexspline::studies
