#include "plan/case_hash.hpp"

#include <nlohmann/json.hpp>

#include "config/study_json.hpp"
#include "flexspline/data/checksum.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

ordered_json recordings_json(const StudyPlan& plan, const InputConfig& input, std::uint64_t seed) {
  const auto set = plan.datasets.find(input.id);
  if (set != plan.datasets.end()) return {{"dataset_sha256", set->second.sha256}};
  return {{"truth", input.truth}, {"bench", to_json(plan.study->bench_of(input))}, {"seed", seed}};
}

/// Everything that an estimate depends on, but for the program: its data by their content.
ordered_json fit_json(const StudyPlan& plan, const CasePlan& one) {
  const Grid* grid = plan.study->find_grid(one.estimator->train);
  return {{"recordings", recordings_json(plan, *one.input, one.seed)},
          {"train", one.train},
          {"loops", grid != nullptr ? to_json(grid->loops) : ordered_json::array()},
          {"steady", one.estimator->steady},
          {"method", one.estimator->method},
          {"model", one.estimator->model ? to_json(*one.estimator->model) : ordered_json()},
          {"options", to_json(one.estimator->options)}};
}

}  // namespace

std::string fit_hash(const StudyPlan& plan, const CasePlan& one) {
  return data::sha256_hex(fit_json(plan, one).dump());
}

std::string case_hash(const StudyPlan& plan, const CasePlan& one, const std::string& build_id) {
  const ordered_json text = {{"build", build_id},
                             {"key", one.key},
                             {"fit", fit_json(plan, one)},
                             {"holdout", one.holdout}};
  return data::sha256_hex(text.dump());
}

std::string input_hash(const StudyPlan& plan, const InputPlan& input, const std::string& build_id) {
  const auto note = plan.notes.find(input.input->id);
  const ordered_json text = {{"build", build_id},
                             {"key", input.key},
                             {"title", input.input->title},
                             {"split", note == plan.notes.end() ? "" : note->second},
                             {"recordings", recordings_json(plan, *input.input, input.seed)},
                             {"train", to_json(input.train_loops)},
                             {"holdout", to_json(input.holdout_loops)}};
  return data::sha256_hex(text.dump());
}

}  // namespace flexspline::studies
