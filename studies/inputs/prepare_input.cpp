#include <algorithm>

#include <fmt/format.h>

#include "flexspline/core/torsion_record.hpp"
#include "inputs/prepared_input.hpp"

namespace flexspline::studies {
namespace {

struct NamedLoop {
  std::string id;
  Loop loop;
  Split split;
};

std::vector<NamedLoop> loops_to_record(const InputPlan& input) {
  std::vector<NamedLoop> loops;
  for (const Loop& loop : input.train_loops) {
    loops.push_back({recording_id(loop), loop, Split::train});
  }
  for (const Loop& loop : input.holdout_loops) {
    loops.push_back({"holdout/" + recording_id(loop), loop, Split::holdout});
  }
  return loops;
}

Result<PreparedInput> record_on_bench(const InputPlan& input) {
  const Result<const data::TruthRow*> row = data::find_truth(input.input->truth);
  if (!row) return tl::unexpected(row.error());
  PreparedInput prepared;
  prepared.plan = input;
  auto truth = data::strengthened((*row)->make(), input.input->strength);
  if (!truth) return tl::unexpected(truth.error());
  prepared.truth = std::move(*truth);
  prepared.says = (*row)->summary;
  prepared.source = (*row)->source;
  std::vector<Recording> measured;
  std::vector<KnownTruth> truths;
  const BenchConfig& bench = input.study->bench_of(*input.input);
  for (NamedLoop& named : loops_to_record(input)) {
    const data::BenchExcitation excitation{named.loop.amplitude, named.loop.frequency_hz,
                                           bench.cycles, bench.samples_per_cycle};
    Result<data::BenchRecording> made =
        data::make_recording(*prepared.truth, excitation, bench.sensors, input.seed, named.id);
    if (!made) return tl::unexpected(in_context(made.error(), "recording " + named.id));
    made->measured.split = named.split;
    measured.push_back(std::move(made->measured));
    truths.push_back({std::move(made->motion), std::move(made->torque)});
  }
  const RecordingSet set = data::paper_bench(input.input->id, std::move(measured));
  prepared.rig = set.rig;
  prepared.units = set.display;
  Result<std::vector<TorsionRecord>> records = torsion_records(set);
  if (!records) return tl::unexpected(records.error());
  for (std::size_t i = 0; i < records->size(); ++i) {
    prepared.recordings.push_back({std::move((*records)[i]), std::move(truths[i])});
  }
  return prepared;
}

Result<PreparedInput> take_from_dataset(const RecordingSet& set, const InputPlan& input,
                                        const std::string& note) {
  Result<std::vector<TorsionRecord>> records = torsion_records(set);
  if (!records) return tl::unexpected(records.error());
  PreparedInput prepared;
  prepared.plan = input;
  prepared.rig = set.rig;
  prepared.says = set.note.empty() ? note : fmt::format("{}; {}", set.note, note);
  prepared.source = set.source;
  prepared.license = set.license;
  prepared.units = set.display;
  for (TorsionRecord& record : *records) prepared.recordings.push_back({std::move(record), {}});
  return prepared;
}

}  // namespace

const StudyRecording* PreparedInput::find(std::string_view id) const {
  const auto found = std::ranges::find(
      recordings, id, [](const StudyRecording& r) -> std::string_view { return r.record.id; });
  return found == recordings.end() ? nullptr : &*found;
}

Result<PreparedInput> prepare_input(const StudyPlan& study, const InputPlan& input) {
  const auto set = study.datasets.find(input.input->id);
  Result<PreparedInput> prepared =
      set == study.datasets.end()
          ? record_on_bench(input)
          : take_from_dataset(set->second, input, study.notes.at(input.input->id));
  if (!prepared) return tl::unexpected(in_context(prepared.error(), "input " + input.key));
  return prepared;
}

}  // namespace flexspline::studies
