#include "paper/virtual_recording.hpp"

#include <algorithm>
#include <cmath>
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

double effort_at(const TorsionRecord& record, double instant) {
  const auto above = std::ranges::lower_bound(record.time, instant) - record.time.begin();
  const auto last = static_cast<std::ptrdiff_t>(record.time.size()) - 1;
  const auto right = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above, 1, last));
  const double share =
      (instant - record.time[right - 1]) / (record.time[right] - record.time[right - 1]);
  return record.effort[right - 1] + share * (record.effort[right] - record.effort[right - 1]);
}

/// Torque at a phase of the fitted cosine, averaged over the cycles after the run-up.
double steady_effort(const PaperExperiment& experiment, double phase) {
  const double period = 1.0 / experiment.sine.frequency_hz;
  const double begin = experiment.record.time.front() + period;
  const double end = experiment.record.time.back();
  double instant = period * (phase - experiment.sine.phase) / (2.0 * std::numbers::pi);
  instant += period * std::ceil((begin - instant) / period);
  double sum = 0.0;
  int count = 0;
  for (; instant <= end; instant += period, ++count) sum += effort_at(experiment.record, instant);
  return count > 0 ? sum / count : kNotComputed;
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
  PaperExperiment experiment;
  experiment.recording = std::move(*recording);
  experiment.sine = fit_sine(record->time, record->motion, kFrequencyHz);
  experiment.record = std::move(*record);
  experiment.estimate = std::move(*estimate);
  return experiment;
}

MidpointLocus midpoint_locus(const PaperExperiment& experiment) {
  constexpr int kPoints = 160;
  const double amplitude = experiment.sine.amplitude * kDegreesPerRad;
  const double omega = 2.0 * std::numbers::pi * experiment.sine.frequency_hz;
  MidpointLocus locus;
  for (int i = 1; i < kPoints; ++i) {
    const double phase = std::numbers::pi * i / kPoints;
    const double down = steady_effort(experiment, phase);
    const double up = steady_effort(experiment, 2.0 * std::numbers::pi - phase);
    locus.torsion.push_back(amplitude * std::cos(phase));
    locus.mean.push_back(0.5 * (up + down));
    locus.speed.push_back(amplitude * omega * std::sin(phase));
    locus.half_difference.push_back(0.5 * (up - down));
  }
  return locus;
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
