#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "flexspline/core/nearest_name.hpp"
#include "flexspline/core/torsion_record.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/data/sanity.hpp"
#include "flexspline/studies/plan.hpp"
#include "plan/variant_plan.hpp"

namespace flexspline::studies {
namespace {

/// Exactly the recordings named are held out.
Result<void> hold_out(const std::vector<std::string>& ids, RecordingSet& set, std::string& note) {
  std::vector<std::string_view> names;
  for (Recording& recording : set.recordings) {
    recording.split = Split::train;
    names.emplace_back(recording.id);
  }
  for (const std::string& id : ids) {
    const auto found = std::ranges::find(set.recordings, id, &Recording::id);
    if (found == set.recordings.end()) {
      const auto nearest = nearest_name(id, names);
      return failure(ErrorCode::bad_data, fmt::format("there is no recording '{}' to hold out", id),
                     nearest ? fmt::format("did you mean '{}'?", *nearest)
                             : fmt::format("it has {}", fmt::join(names, ", ")));
    }
    found->split = Split::holdout;
  }
  note = ids.empty() ? "every recording is trained on; none is held out"
                     : fmt::format("held out as asked: {}", fmt::join(ids, ", "));
  return {};
}

/// What was decided in reading comes after what was decided in splitting.
void add_notes(const RecordingSet& set, std::string& note) {
  for (const std::string& one : set.notes) note += (note.empty() ? "" : "; ") + one;
}

Result<RecordingSet> split_dataset(const InputConfig& input, std::string& note) {
  Result<RecordingSet> set = data::load_dataset(input.dataset, input.rows);
  if (!set) return tl::unexpected(in_context(set.error(), "input " + input.id));
  Result<std::vector<TorsionRecord>> records = torsion_records(*set);
  if (!records) return tl::unexpected(in_context(records.error(), "input " + input.id));
  if (input.held_out) {
    if (auto held = hold_out(*input.held_out, *set, note); !held) {
      return tl::unexpected(in_context(held.error(), "input " + input.id));
    }
    add_notes(*set, note);
    return set;
  }
  note = split_recordings(*records);
  add_notes(*set, note);
  for (std::size_t i = 0; i < records->size(); ++i) set->recordings[i].split = (*records)[i].split;
  return set;
}

/// Errors: bad_data, where a data set looks so mistaken that it stops science.
Result<void> look_at(const InputConfig& input, const RecordingSet& set) {
  const auto findings = data::sanity_of(set);
  if (!data::stops_science(findings)) return {};
  return failure(ErrorCode::bad_data,
                 fmt::format("input {}: {}", input.id, findings.front().message()),
                 fmt::format("flexspline validate {} lists what looks mistaken; where it is none, "
                             "accept = [\"{}\"] in its dataset.toml says so",
                             input.dataset.string(), findings.front().check));
}

Result<void> load_datasets(StudyPlan& plan) {
  for (const InputConfig& input : plan.study->inputs) {
    if (input.dataset.empty()) continue;
    Result<RecordingSet> set = split_dataset(input, plan.notes[input.id]);
    if (!set) return tl::unexpected(set.error());
    if (auto sound = look_at(input, *set); !sound) return sound;
    plan.datasets.emplace(input.id, std::move(*set));
  }
  return {};
}

/// The sweeps that an input's recordings, or an estimator's fit of them, depend on.
bool depends(const SweepKey& key, const StudyConfig& study, const InputConfig& input,
             const EstimatorConfig& estimator) {
  const std::size_t dot = key.path.find('.');
  const std::string head = key.path.substr(0, dot);
  const std::string rest = dot == std::string::npos ? "" : key.path.substr(dot + 1);
  const auto names = [&](const std::string& id) {
    return rest.starts_with("*.") || rest.starts_with(id + ".");
  };
  const bool recorded_here = !input.truth.empty();
  if (head == "bench" || head == "seed") return recorded_here;
  if (head == "input") return names(input.id);
  if (head == "estimator") return names(estimator.written_id());
  if (head == "grid" && study.kind == "grid") {
    return recorded_here && (names(estimator.train) || names(input.holdout));
  }
  return true;
}

bool depends(const SweepAxis& sweep, const StudyConfig& study, const InputConfig& input,
             const EstimatorConfig& estimator) {
  return std::ranges::any_of(
      sweep.keys, [&](const SweepKey& key) { return depends(key, study, input, estimator); });
}

std::vector<Cell> cells_of(const StudyConfig& study) {
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < study.inputs.size(); ++i) {
    for (std::size_t e = 0; e < study.estimators.size(); ++e) {
      if (!uses(study.estimators[e], study.inputs[i])) continue;
      Cell cell{i, e, {}};
      for (const SweepAxis& sweep : study.sweeps) {
        cell.swept.push_back(depends(sweep, study, study.inputs[i], study.estimators[e]));
      }
      cells.push_back(std::move(cell));
    }
  }
  return cells;
}

}  // namespace

std::uint64_t seed_of(const StudyConfig& study, int replicate) {
  return study.seed + static_cast<std::uint64_t>(replicate);
}

bool uses(const EstimatorConfig& estimator, const InputConfig& input) {
  return estimator.inputs.empty() ||
         std::ranges::find(estimator.inputs, input.id) != estimator.inputs.end();
}

Result<StudyPlan> plan_study(const StudyConfig& study, const std::string& build_id) {
  StudyPlan plan;
  plan.study = &study;
  plan.build_id_ = build_id;
  plan.variants_ = std::make_shared<VariantCache>();
  if (const auto loaded = load_datasets(plan); !loaded) return tl::unexpected(loaded.error());
  plan.cells = cells_of(study);
  plan.number_cells();
  const auto first = plan.variant(0);
  if (first->problem) return tl::unexpected(*first->problem);
  for (const InputConfig& input : first->study->inputs) {
    plan.inputs.push_back(first->input(plan, input, 0));
  }
  return plan;
}

}  // namespace flexspline::studies
