#include "plan/case_hash.hpp"

#include <nlohmann/json.hpp>

#include "config/study_json.hpp"
#include "flexspline/data/checksum.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

/// Where recordings come from: data by their content.
ordered_json recordings_json(const StudyPlan& plan, const StudyConfig& study,
                             const InputConfig& input) {
  const auto set = plan.datasets.find(input.id);
  if (set != plan.datasets.end()) return {{"dataset_sha256", set->second.sha256}};
  return {{"truth", input.truth},
          {"strength", input.strength},
          {"bench", to_json(study.bench_of(input))}};
}

}  // namespace

std::string fit_hash(const StudyPlan& plan, const StudyConfig& study, const InputConfig& input,
                     const EstimatorConfig& estimator, const CellPlan& cell) {
  const Grid* grid = study.find_grid(estimator.train);
  const ordered_json text = {
      {"recordings", recordings_json(plan, study, input)},
      {"train", cell.train},
      {"loops", grid != nullptr ? to_json(grid->loops) : ordered_json::array()},
      {"steady", estimator.steady},
      {"method", estimator.method},
      {"model", estimator.model ? to_json(*estimator.model) : ordered_json()},
      {"options", to_json(estimator.options)}};
  return data::sha256_hex(text.dump());
}

std::string case_hash(const CellPlan& cell) {
  return data::sha256_hex(ordered_json(cell.holdout).dump());
}

std::string input_hash(const StudyPlan& plan, const InputPlan& input, const std::string& build_id) {
  const auto note = plan.notes.find(input.input->id);
  const ordered_json text = {{"build", build_id},
                             {"key", input.key},
                             {"title", input.input->title},
                             {"split", note == plan.notes.end() ? "" : note->second},
                             {"recordings", recordings_json(plan, *input.study, *input.input)},
                             {"seed", input.seed},
                             {"train", to_json(input.train_loops)},
                             {"holdout", to_json(input.holdout_loops)}};
  return data::sha256_hex(text.dump());
}

}  // namespace flexspline::studies
