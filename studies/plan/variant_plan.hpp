#pragma once

#include <optional>

#include "flexspline/studies/plan.hpp"
#include "inputs/recent.hpp"

namespace flexspline::studies {

/// What the cases of a cell share, whatever their seed.
struct CellPlan {
  std::vector<std::string> train;
  std::vector<std::string> holdout;
  long train_samples = 0;
  std::string fit;    ///< SHA-256 over what the estimate depends on but for the seed
  std::string whole;  ///< the same of the case's result
};

/// One variant of the study with its cells and inputs.
struct VariantPlan {
  std::shared_ptr<const StudyConfig> study;
  std::vector<CellPlan> cells;
  std::optional<Error> problem;  ///< of making it

  InputPlan input(const StudyPlan& plan, const InputConfig& input, int replicate) const;
};

/// Neighbours in the plan share a variant.
struct VariantCache : Recent<std::size_t, VariantPlan> {
  VariantCache() : Recent(64) {}
};

/// Whether an estimator runs on an input.
bool uses(const EstimatorConfig& estimator, const InputConfig& input);

/// Errors: of the view of a data set's recordings.
Result<CellPlan> plan_cell(const StudyPlan& plan, const StudyConfig& study, const Cell& cell);

}  // namespace flexspline::studies
