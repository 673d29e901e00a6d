#include "results/results_axes.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace flexspline::studies {
namespace {

template <class T>
void add_once(std::vector<T>& list, const T& value) {
  if (index_in(list, value) == list.size()) list.push_back(value);
}

/// Units of parameters, "" where a pair has no such parameter.
void add_units(const StudyRows& rows, ResultsAxes& axes) {
  const StudyConfig& study = rows.study();
  axes.units.resize(study.inputs.size() * study.estimators.size() * axes.parameters.size());
  rows.each([&](const CasePlan& one, const CaseRow& row) {
    const std::size_t pair =
        input_index(study, one) * study.estimators.size() + estimator_index(study, one);
    for (const CaseRow::Parameter& parameter : row.parameters) {
      const std::size_t p = index_in(axes.parameters, parameter.name);
      axes.units[pair * axes.parameters.size() + p] = parameter.unit;
    }
  });
}

}  // namespace

bool on_grid(const CasePlan& one, const CaseRow::Recording& recording) {
  return !one.input->truth.empty() && recording.role == "holdout";
}

double tidy(double value) { return std::round(value * 1e9) / 1e9; }

std::size_t input_index(const StudyConfig& study, const CasePlan& one) {
  const auto found = std::ranges::find(study.inputs, one.input->id, &InputConfig::id);
  return static_cast<std::size_t>(found - study.inputs.begin());
}

std::size_t estimator_index(const StudyConfig& study, const CasePlan& one) {
  const auto found = std::ranges::find(study.estimators, one.estimator->id, &EstimatorConfig::id);
  return static_cast<std::size_t>(found - study.estimators.begin());
}

ResultsAxes axes_of(const StudyRows& rows) {
  ResultsAxes axes;
  std::set<std::string> numbers;
  rows.each([&](const CasePlan& one, const CaseRow& row) {
    for (const CaseRow::Parameter& parameter : row.parameters) {
      add_once(axes.parameters, parameter.name);
    }
    for (const auto& [name, value] : row.numbers) numbers.insert(name);
    axes.rows += row.recordings.size();
    for (const CaseRow::Recording& recording : row.recordings) {
      if (!on_grid(one, recording)) continue;
      add_once(axes.amplitudes, tidy(recording.amplitude));
      add_once(axes.frequencies, tidy(recording.frequency_hz));
    }
  });
  axes.numbers.assign(numbers.begin(), numbers.end());
  std::ranges::sort(axes.amplitudes);
  std::ranges::sort(axes.frequencies);
  add_units(rows, axes);
  return axes;
}

}  // namespace flexspline::studies
