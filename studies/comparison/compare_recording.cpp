#include "comparison/compare_recording.hpp"

#include <algorithm>

#include "comparison/decimate.hpp"
#include "comparison/recording_zero.hpp"
#include "flexspline/core/model_domain.hpp"
#include "flexspline/core/signals.hpp"
#include "flexspline/core/simulate.hpp"

namespace flexspline::studies {
namespace {

/// Index of the first sample at or after an instant.
std::size_t index_at(const std::vector<double>& time, double instant) {
  return static_cast<std::size_t>(std::ranges::lower_bound(time, instant) - time.begin());
}

void count_after_run_up(const TorsionRecord& record, ComparedSeries& series) {
  const double period = record.frequency_hz ? 1.0 / *record.frequency_hz : 0.0;
  const double start = record.time.front();
  const double step = (record.time.back() - start) / static_cast<double>(record.time.size() - 1);
  const std::size_t first = index_at(record.time, start + period - 0.5 * step);
  series.counts.assign(record.time.size(), false);
  std::fill(series.counts.begin() + static_cast<std::ptrdiff_t>(first), series.counts.end(), true);
  series.cycle_last = record.time.size();
  series.cycle_first = index_at(record.time, record.time.back() - period + 0.5 * step);
}

void count_valid(const TorsionRecord& record, const Reconstruction& smooth,
                 ComparedSeries& series) {
  series.counts = record.valid;
  series.counts.resize(record.time.size(), true);
  if (!smooth.steady) return;
  series.cycle_last = smooth.steady->last;
  const double end = record.time[smooth.steady->last - 1];
  const double step = end - record.time[smooth.steady->last - 2];
  series.cycle_first = std::max(smooth.steady->first,
                                index_at(record.time, end - smooth.steady->period + 0.5 * step));
}

Result<Motion> motion_of(const StudyRecording& recording, ComparedSeries& series) {
  const TorsionRecord& record = recording.record;
  series.measured = record.effort;
  if (recording.truth) {
    series.truth = recording.truth->torque;
    count_after_run_up(record, series);
    return recording.truth->motion;
  }
  Result<Reconstruction> smooth = reconstruct(record);
  if (!smooth) return tl::unexpected(smooth.error());
  count_valid(record, *smooth, series);
  return std::move(smooth->motion);
}

/// More than 1 % of the compared samples outside of the model's domain.
Result<bool> leaves_domain(const ModelSpec& model, const Motion& motion,
                           const ComparedSeries& series) {
  const auto domain = ModelDomain::of(model);
  if (!domain) return tl::unexpected(domain.error());
  std::size_t outside = 0;
  std::size_t total = 0;
  for (std::size_t i = 0; i < motion.position.size(); ++i) {
    if (!series.counts[i]) continue;
    ++total;
    if (!domain->holds_at(motion.position[i], motion.velocity[i])) ++outside;
  }
  return outside * 100 > total;
}

void keep_series(const ComparedSeries& series, RecordingComparison& comparison) {
  const bool cyclic = series.cycle_last > series.cycle_first;
  const std::size_t closing = series.cycle_first > 0 ? series.cycle_first - 1 : 0;
  const auto kept =
      cyclic ? kept_indices(closing, series.cycle_last) : kept_indices(0, series.motion.size());
  comparison.motion = at_indices(series.motion, kept);
  comparison.measured = at_indices(series.measured, kept);
  comparison.simulated = at_indices(series.simulated, kept);
}

}  // namespace

Result<RecordingComparison> compare_recording(const Estimate& estimate,
                                              const StudyRecording& recording, bool trained) {
  ComparedSeries series;
  Result<Motion> motion = motion_of(recording, series);
  if (!motion) return tl::unexpected(motion.error());
  series.motion = motion->position;
  const Result<double> zero = recording_zero(estimate, recording.record.id, *motion, series);
  if (!zero) return tl::unexpected(zero.error());
  for (double& position : motion->position) position -= *zero;
  Result<std::vector<double>> simulated = simulate_torque(estimate.model, *motion);
  if (!simulated) return tl::unexpected(simulated.error());
  series.simulated = std::move(*simulated);
  const Result<bool> outside = leaves_domain(estimate.model, *motion, series);
  if (!outside) return tl::unexpected(outside.error());

  RecordingComparison comparison;
  comparison.id = recording.record.id;
  comparison.trained = trained;
  comparison.outside_domain = *outside;
  for (const MetricRow& row : metrics()) {
    comparison.metrics.emplace(std::string(row.id), row.compute(series));
  }
  keep_series(series, comparison);
  return comparison;
}

}  // namespace flexspline::studies
