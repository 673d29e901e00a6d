#include "run/study_cases.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "flexspline/data/artefact.hpp"
#include "results/row_json.hpp"
#include "run/compute_case.hpp"
#include "run/make_row.hpp"

namespace flexspline::studies {
namespace {

constexpr std::size_t kInputs = 64;  // kept at once, beside those of the study's own list
constexpr std::size_t kEstimates = 512;

CaseResult result_of(const CasePlan& one, const PreparedInput* input, const CaseOutcome& outcome) {
  CaseResult result;
  const bool done = input != nullptr && outcome.estimate.has_value();
  if (done) {
    result.seconds = outcome.estimate->seconds;
    result.row = row_json(make_row(one, *input, outcome)).dump();
  } else {
    result.failure = outcome.estimate.error().message();
    if (result.failure.empty()) result.failure = "it failed";
  }
  result.artefact = data::sealed(case_json(one, input, outcome));
  return result;
}

}  // namespace

StudyCases::StudyCases(const StudyPlan& plan)
    : plan_(&plan), inputs_(kInputs + plan.inputs.size()), estimates_(kEstimates) {}

StudyCases::Prepared StudyCases::prepared(const InputPlan& input) {
  return inputs_.take(input.depends_on, [&] { return prepare_input(*plan_, input); });
}

CaseName StudyCases::name(std::size_t number) const {
  CasePlan one = plan_->at(number);
  return {std::move(one.key), std::move(one.depends_on)};
}

CaseResult StudyCases::compute(std::size_t number) {
  const CasePlan one = plan_->at(number);
  if (one.problem) return give_up(number, *one.problem);
  const Prepared input = prepared(plan_->input_of(one));
  const auto estimate =
      estimates_.take(one.fit_depends_on, [&] { return estimate_case(one, *input); });
  return result_of(one, input->has_value() ? &input->value() : nullptr,
                   compare_case(one, *input, *estimate));
}

CaseResult StudyCases::give_up(std::size_t number, const Error& why) {
  return result_of(plan_->at(number), nullptr, {tl::unexpected(why), {}});
}

}  // namespace flexspline::studies
