#include "run/compute_case.hpp"

#include <exception>
#include <new>

#include <fmt/format.h>

namespace flexspline::studies {
namespace {

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
  problem.model = plan.estimator->model;
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

CaseOutcome compare(const CasePlan& plan, const PreparedInput& input,
                    const Result<Estimate>& estimate) {
  CaseOutcome outcome{estimate, {}};
  const auto add = [&](const std::string& id, bool trained) {
    auto comparison = compare_recording(*estimate, *input.find(id), trained);
    if (comparison) {
      outcome.recordings.push_back(std::move(*comparison));
    } else {
      outcome = {tl::unexpected(in_context(comparison.error(), "recording " + id)), {}};
    }
    return outcome.estimate.has_value();
  };
  for (const std::string& id : plan.train) {
    if (!add(id, true)) return outcome;
  }
  for (const std::string& id : plan.holdout) {
    if (!add(id, false)) return outcome;
  }
  return outcome;
}

tl::unexpected<Error> defect(const CasePlan& plan, const std::exception& error) {
  return failure(ErrorCode::defect, fmt::format("{}: {}", plan.key, error.what()),
                 "please report it with the study file");
}

}  // namespace

Result<Estimate> estimate_case(const CasePlan& plan, const Result<PreparedInput>& input) {
  if (!input) return tl::unexpected(input.error());
  try {
    return estimate_of(plan, *input);
  } catch (const std::bad_alloc&) {
    throw;  // the engine's to say
  } catch (const std::exception& error) {
    return defect(plan, error);
  }
}

CaseOutcome compare_case(const CasePlan& plan, const Result<PreparedInput>& input,
                         const Result<Estimate>& estimate) {
  if (!estimate) return {tl::unexpected(estimate.error()), {}};
  try {
    return compare(plan, *input, estimate);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return {defect(plan, error), {}};
  }
}

}  // namespace flexspline::studies
