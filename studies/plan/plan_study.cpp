#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "flexspline/core/nearest_name.hpp"
#include "flexspline/core/torsion_record.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/studies/plan.hpp"
#include "plan/case_hash.hpp"
#include "plan/motion_range.hpp"

namespace flexspline::studies {
namespace {

constexpr double kSecondsPerSample = 5e-5;  // order of magnitude, for plan's estimate only
constexpr double kBytesPerRecording = 15e3;

bool uses(const EstimatorConfig& estimator, const InputConfig& input) {
  return estimator.inputs.empty() ||
         std::ranges::find(estimator.inputs, input.id) != estimator.inputs.end();
}

void add_once(std::vector<Loop>& loops, const std::vector<Loop>& more) {
  for (const Loop& loop : more) {
    if (std::ranges::find(loops, loop) == loops.end()) loops.push_back(loop);
  }
}

std::vector<Loop> loops_of(const StudyConfig& study, const std::string& grid) {
  const Grid* found = study.find_grid(grid);
  return found == nullptr ? std::vector<Loop>{} : found->loops;
}

void train_on_bench(CasePlan& plan, const StudyConfig& study) {
  for (const Loop& loop : loops_of(study, plan.estimator->train)) {
    plan.train.push_back(recording_id(loop));
    plan.train_samples += static_cast<long>(study.bench.cycles) * study.bench.samples_per_cycle;
  }
  for (const Loop& loop : loops_of(study, plan.input->holdout)) {
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

Result<void> train_on_dataset(CasePlan& plan, const RecordingSet& set) {
  const auto records = torsion_records(set);
  if (!records) return tl::unexpected(records.error());
  const Recording* one = plan.estimator->train == kTrainOne ? largest(set, *records) : nullptr;
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

Result<void> load_datasets(StudyPlan& plan) {
  for (const InputConfig& input : plan.study->inputs) {
    if (input.dataset.empty()) continue;
    Result<RecordingSet> set = split_dataset(input, plan.notes[input.id]);
    if (!set) return tl::unexpected(set.error());
    plan.datasets.emplace(input.id, std::move(*set));
  }
  return {};
}

InputPlan plan_input(const StudyConfig& study, const InputConfig& input, int replicate) {
  InputPlan plan;
  plan.key = replicate == 0 ? input.id : fmt::format("{}-r{}", input.id, replicate);
  plan.input = &input;
  plan.replicate = replicate;
  plan.seed = seed_of(study, replicate);
  if (input.truth.empty()) return plan;
  for (const EstimatorConfig& estimator : study.estimators) {
    if (uses(estimator, input)) add_once(plan.train_loops, loops_of(study, estimator.train));
  }
  plan.holdout_loops = loops_of(study, input.holdout);
  return plan;
}

Result<CasePlan> plan_case(const StudyPlan& whole, const InputPlan& input,
                           const EstimatorConfig& estimator) {
  CasePlan plan;
  plan.key = fmt::format("{}--{}--r{}", input.input->id, estimator.id, input.replicate);
  plan.input = input.input;
  plan.estimator = &estimator;
  plan.replicate = input.replicate;
  plan.seed = input.seed;
  const auto set = whole.datasets.find(input.input->id);
  if (set == whole.datasets.end()) {
    train_on_bench(plan, *whole.study);
  } else if (const auto trained = train_on_dataset(plan, set->second); !trained) {
    return tl::unexpected(trained.error());
  }
  return plan;
}

}  // namespace

std::uint64_t seed_of(const StudyConfig& study, int replicate) {
  return study.seed + static_cast<std::uint64_t>(replicate);
}

Result<StudyPlan> plan_study(const StudyConfig& study, const std::string& build_id) {
  StudyPlan plan;
  plan.study = &study;
  if (const auto loaded = load_datasets(plan); !loaded) return tl::unexpected(loaded.error());
  for (int replicate = 0; replicate < study.replicates; ++replicate) {
    for (const InputConfig& input : study.inputs) {
      InputPlan prepared = plan_input(study, input, replicate);
      prepared.depends_on = input_hash(plan, prepared, build_id);
      for (const EstimatorConfig& estimator : study.estimators) {
        if (!uses(estimator, input)) continue;
        Result<CasePlan> planned = plan_case(plan, prepared, estimator);
        if (!planned) return tl::unexpected(planned.error());
        planned->fit_depends_on = fit_hash(plan, *planned);
        planned->depends_on = case_hash(plan, *planned, build_id);
        plan.estimated_seconds += kSecondsPerSample * static_cast<double>(planned->train_samples);
        plan.estimated_bytes += kBytesPerRecording * static_cast<double>(planned->train.size() +
                                                                         planned->holdout.size());
        plan.cases.push_back(std::move(*planned));
      }
      plan.inputs.push_back(std::move(prepared));
    }
  }
  return plan;
}

}  // namespace flexspline::studies
