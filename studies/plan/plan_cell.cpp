#include <algorithm>

#include "flexspline/core/torsion_record.hpp"
#include "plan/case_hash.hpp"
#include "plan/motion_range.hpp"
#include "plan/variant_plan.hpp"

namespace flexspline::studies {
namespace {

std::vector<Loop> loops_of(const StudyConfig& study, const std::string& grid) {
  const Grid* found = study.find_grid(grid);
  return found == nullptr ? std::vector<Loop>{} : found->loops;
}

void add_once(std::vector<Loop>& loops, const std::vector<Loop>& more) {
  for (const Loop& loop : more) {
    if (std::ranges::find(loops, loop) == loops.end()) loops.push_back(loop);
  }
}

void train_on_bench(CellPlan& plan, const StudyConfig& study, const InputConfig& input,
                    const EstimatorConfig& estimator) {
  const BenchConfig& bench = study.bench_of(input);
  for (const Loop& loop : loops_of(study, estimator.train)) {
    plan.train.push_back(recording_id(loop));
    plan.train_samples += static_cast<long>(bench.cycles) * bench.samples_per_cycle;
  }
  for (const Loop& loop : loops_of(study, input.holdout)) {
    plan.holdout.push_back("holdout/" + recording_id(loop));
  }
}

/// The training recording with the largest motion, among those with a frequency where there are
/// any.
const Recording* largest(const RecordingSet& set, const std::vector<TorsionRecord>& records) {
  const Recording* best = nullptr;
  std::pair<bool, double> rank{false, -1.0};
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (set.recordings[i].split != Split::train) continue;
    const std::pair own{records[i].frequency_hz.has_value(), motion_range(records[i])};
    if (best != nullptr && own <= rank) continue;
    best = &set.recordings[i];
    rank = own;
  }
  return best;
}

Result<void> train_on_dataset(CellPlan& plan, const EstimatorConfig& estimator,
                              const RecordingSet& set) {
  const auto records = torsion_records(set);
  if (!records) return tl::unexpected(records.error());
  const Recording* one = estimator.train == kTrainOne ? largest(set, *records) : nullptr;
  for (const Recording& recording : set.recordings) {
    if (recording.split == Split::holdout)
      plan.holdout.push_back(recording.id);
    else if (one == nullptr || one == &recording) {
      plan.train.push_back(recording.id);
      plan.train_samples += static_cast<long>(recording.time.size());
    }
  }
  return {};
}

}  // namespace

Result<CellPlan> plan_cell(const StudyPlan& plan, const StudyConfig& study, const Cell& cell) {
  CellPlan planned;
  const InputConfig& input = study.inputs.at(cell.input);
  const EstimatorConfig& estimator = study.estimators.at(cell.estimator);
  const auto set = plan.datasets.find(input.id);
  if (set == plan.datasets.end()) {
    train_on_bench(planned, study, input, estimator);
  } else if (const auto trained = train_on_dataset(planned, estimator, set->second); !trained) {
    return tl::unexpected(trained.error());
  }
  planned.fit = fit_hash(plan, study, input, estimator, planned);
  planned.whole = case_hash(planned);
  return planned;
}

InputPlan VariantPlan::input(const StudyPlan& plan, const InputConfig& input, int replicate) const {
  InputPlan planned;
  planned.key = input.id;
  planned.study = study;
  planned.input = &input;
  planned.replicate = replicate;
  planned.seed = seed_of(*study, replicate);
  if (!input.truth.empty()) {
    for (const EstimatorConfig& estimator : study->estimators) {
      if (uses(estimator, input)) add_once(planned.train_loops, loops_of(*study, estimator.train));
    }
    planned.holdout_loops = loops_of(*study, input.holdout);
  }
  planned.depends_on = input_hash(plan, planned, plan.build_id());
  return planned;
}

}  // namespace flexspline::studies
