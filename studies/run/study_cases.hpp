#pragma once

#include "flexspline/studies/engine.hpp"
#include "flexspline/studies/plan.hpp"
#include "inputs/prepared_input.hpp"
#include "inputs/recent.hpp"

namespace flexspline::studies {

/// The cases of a plan: estimated and compared. Recordings and estimates that several cases share
/// are made once, as long as these stand near each other in the plan.
class StudyCases : public CaseSource {
 public:
  explicit StudyCases(const StudyPlan& plan);

  std::size_t size() const override { return plan_->size(); }
  CaseName name(std::size_t number) const override;
  CaseResult compute(std::size_t number) override;
  CaseResult give_up(std::size_t number, const Error& why) override;

  using Prepared = std::shared_ptr<const Result<PreparedInput>>;
  Prepared prepared(const InputPlan& input);

 private:
  const StudyPlan* plan_;
  Recent<std::string, Result<PreparedInput>> inputs_;
  Recent<std::string, Result<Estimate>> estimates_;  ///< by fit_depends_on
};

}  // namespace flexspline::studies
