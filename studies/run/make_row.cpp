#include "run/make_row.hpp"

#include <algorithm>
#include <cmath>

#include "comparison/band_figures.hpp"
#include "comparison/function_errors.hpp"
#include "comparison/middle_of.hpp"
#include "flexspline/core/signals.hpp"
#include "flexspline/core/units.hpp"

namespace flexspline::studies {
namespace {

double known_or(const RecordingComparison& recording, const char* known, const char* otherwise) {
  const double value = recording.metrics.at(known);
  return std::isnan(value) ? recording.metrics.at(otherwise) : value;
}

void add_recordings(const PreparedInput& input, const CaseOutcome& outcome, CaseRow& row) {
  std::vector<double> held;
  double worst = kNotComputed;
  for (const RecordingComparison& one : outcome.recordings) {
    const StudyRecording& recording = *input.find(one.id);
    const double percent = known_or(one, "rmse_true_percent_of_peak", "rmse_percent_of_peak");
    row.recordings.push_back({one.id, one.trained ? "train" : "holdout",
                              shown(amplitude_of(recording), input.units.motion),
                              recording.record.frequency_hz.value_or(kNotComputed), percent,
                              known_or(one, "rmse_true", "rmse"), one.outside_domain});
    if (one.trained) continue;
    held.push_back(percent);
    if (!(worst >= percent)) worst = percent;
  }
  row.numbers["holdout_median_percent"] = middle_of(held);
  row.numbers["holdout_worst_percent"] = worst;
}

/// Loop area and peak of the training recording with the largest motion.
void add_loop(const CasePlan& plan, const PreparedInput& input, CaseRow& row) {
  const StudyRecording* largest = nullptr;
  for (const std::string& id : plan.train) {
    const StudyRecording* one = input.find(id);
    if (largest == nullptr || amplitude_of(*one) > amplitude_of(*largest)) largest = one;
  }
  const auto loop = largest == nullptr ? std::nullopt : loop_figures(largest->record);
  row.numbers["loop_area"] = loop ? loop->area : kNotComputed;
  row.numbers["peak_torque"] = loop ? loop->peak_effort : kNotComputed;
}

}  // namespace

CaseRow make_row(const CasePlan& plan, const PreparedInput& input, const CaseOutcome& outcome) {
  CaseRow row;
  const Estimate& estimate = *outcome.estimate;
  const auto effort = find_unit(input.units.effort);
  row.linear = effort && effort->dimension == Dimension::force;
  for (const ParameterEstimate& one : estimate.parameters) {
    row.parameters.push_back({one.name, one.value, one.std, one.unit});
  }
  add_recordings(input, outcome, row);
  add_loop(plan, input, row);
  for (const auto& [name, value] : function_errors(estimate, input, plan.train)) {
    row.numbers["error_" + name + "_percent"] = value;
  }
  row.numbers["cost"] = estimate.cost;
  row.numbers["parameters"] = static_cast<double>(estimate.parameters.size());
  row.numbers["samples"] = static_cast<double>(plan.train_samples);
  row.numbers["converged"] = estimate.termination == Termination::converged ? 1.0 : 0.0;
  row.numbers["evaluations"] = static_cast<double>(estimate.evaluations);
  add_band_figures(estimate, input, plan.train, row);
  return row;
}

}  // namespace flexspline::studies
