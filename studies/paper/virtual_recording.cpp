#include "paper/virtual_recording.hpp"

#include <algorithm>
#include <numbers>

#include "flexspline/core/torsion_record.hpp"
#include "flexspline/data/bench.hpp"
#include "flexspline/estimators/method.hpp"
#include "paper/odd_polynomial.hpp"

namespace flexspline::studies {
namespace {

constexpr double kDegreesPerRad = 180.0 / std::numbers::pi;

Result<Recording> record_table_one(const StudyConfig& study) {
  const auto row = data::find_truth("table_i");
  if (!row) return tl::unexpected(row.error());
  const Loop loop{kAmplitudeDeg / kDegreesPerRad, kFrequencyHz};
  const data::BenchExcitation excitation{loop.amplitude, loop.frequency_hz, study.bench.cycles,
                                         study.bench.samples_per_cycle};
  auto made = data::make_recording((*row)->make(), excitation, study.bench.sensors, study.seed,
                                   recording_id(loop));
  if (!made) return tl::unexpected(made.error());
  return std::move(made->measured);
}

}  // namespace

Result<PaperExperiment> repeat_experiment(const StudyConfig& study) {
  Result<Recording> recording = record_table_one(study);
  if (!recording) return tl::unexpected(recording.error());
  const RecordingSet set = data::paper_bench("table_i", {*recording});
  Result<TorsionRecord> record = torsion_record(set, set.recordings.front());
  if (!record) return tl::unexpected(record.error());
  const auto method = estimators::find_method("midpoint_polynomial");
  if (!method) return tl::unexpected(method.error());
  Result<Estimate> estimate = (*method)->fit({{*record}, {}});
  if (!estimate) return tl::unexpected(estimate.error());
  auto locus = estimators::midpoint_locus(*record);
  if (!locus) return tl::unexpected(locus.error());
  PaperExperiment experiment;
  experiment.recording = std::move(*recording);
  experiment.locus = std::move(*locus);
  experiment.record = std::move(*record);
  experiment.estimate = std::move(*estimate);
  return experiment;
}

std::array<Recovered, 5> recovered_coefficients(const Estimate& estimate, char letter) {
  std::array<Recovered, 5> recovered;
  recovered.fill({kNotComputed, kNotComputed});
  for (std::size_t k = 0; k < recovered.size(); ++k) {
    const std::string name = letter + std::to_string(k + 1);
    const auto found = std::ranges::find(estimate.parameters, name, &ParameterEstimate::name);
    if (found != estimate.parameters.end()) recovered[k] = {found->value, found->std};
  }
  return recovered;
}

}  // namespace flexspline::studies
