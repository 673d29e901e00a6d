#include <algorithm>
#include <cmath>
#include <tuple>

#include "results/results_table.hpp"

namespace flexspline::studies {
namespace {

enum Dimension : std::size_t {
  kInput,
  kEstimator,
  kAmplitude,
  kFrequency,
  kReplicate,
  kParameter,
  kRow
};

template <class T>
std::size_t index_in(const std::vector<T>& list, const T& value) {
  return static_cast<std::size_t>(std::ranges::find(list, value) - list.begin());
}

template <class T>
void add_once(std::vector<T>& list, const T& value) {
  if (std::ranges::find(list, value) == list.end()) list.push_back(value);
}

/// Amplitudes come back from degrees with rounding errors that would make axes of their own.
double tidy(double value) { return std::round(value * 1e9) / 1e9; }

class Gatherer {
 public:
  Gatherer(const StudyPlan& plan, std::span<const std::optional<CaseRow>> rows) : plan_(plan) {
    for (std::size_t i = 0; i < plan.cases.size(); ++i) {
      if (rows[i]) cases_.emplace_back(&plan.cases[i], &*rows[i]);
    }
  }

  ResultsTable operator()() {
    make_axes();
    add_errors("error_percent", "hold-out rms error of torque (force), of the recording's peak",
               "percent", &CaseRow::Recording::error_percent);
    add_errors("error", "hold-out rms error of the torque", "N m", &CaseRow::Recording::error);
    add_parameters("parameter_value", "estimates, in the units of parameter_unit",
                   &CaseRow::Parameter::value);
    add_parameters("parameter_std", "standard deviations of the estimates, in the same units",
                   &CaseRow::Parameter::std);
    add_parameter_units();
    add_rows();
    return std::move(table_);
  }

 private:
  void make_axes() {
    table_.axes = {{"input", {}, {}, "", "id of the input"},
                   {"estimator", {}, {}, "", "id of the estimator"},
                   {"amplitude", {}, {}, "degree", "amplitude of the output's motion"},
                   {"frequency", {}, {}, "Hz", "frequency of the output's motion"},
                   {"replicate", {}, {}, "1", "number of the replicate", true},
                   {"parameter", {}, {}, "", "name of the parameter"},
                   {"row", {}, {}, "1", "number of the row", true}};
    for (const InputConfig& input : plan_.study->inputs)
      table_.axes[kInput].labels.push_back(input.id);
    for (const EstimatorConfig& row : plan_.study->estimators)
      table_.axes[kEstimator].labels.push_back(row.id);
    for (int r = 0; r < plan_.study->replicates; ++r) table_.axes[kReplicate].values.push_back(r);
    for (const auto& [one, row] : cases_) {
      for (const CaseRow::Parameter& parameter : row->parameters) {
        add_once(table_.axes[kParameter].labels, parameter.name);
      }
      for (const CaseRow::Recording& recording : row->recordings) {
        table_.axes[kRow].values.push_back(static_cast<double>(table_.axes[kRow].values.size()));
        if (!on_grid(*one, recording)) continue;
        add_once(table_.axes[kAmplitude].values, tidy(recording.amplitude));
        add_once(table_.axes[kFrequency].values, tidy(recording.frequency_hz));
      }
    }
    std::ranges::sort(table_.axes[kAmplitude].values);
    std::ranges::sort(table_.axes[kFrequency].values);
  }

  static bool on_grid(const CasePlan& one, const CaseRow::Recording& recording) {
    return !one.input->truth.empty() && recording.role == "holdout";
  }

  /// A variable full of NaN.
  Variable& add(const char* name, const char* says, const char* unit,
                std::vector<std::size_t> axes) {
    std::size_t size = 1;
    for (const std::size_t axis : axes) size *= table_.axes[axis].size();
    return table_.variables.emplace_back(
        Variable{name, says, unit, std::move(axes), std::vector<double>(size, kNone), {}});
  }

  double& at(Variable& variable, const std::vector<std::size_t>& indices) const {
    std::size_t offset = 0;
    for (std::size_t i = 0; i < indices.size(); ++i) {
      offset = offset * table_.axes[variable.axes[i]].size() + indices[i];
    }
    return variable.values.at(offset);
  }

  std::size_t input_of(const CasePlan& one) const {
    return index_in(table_.axes[kInput].labels, one.input->id);
  }
  std::size_t estimator_of(const CasePlan& one) const {
    return index_in(table_.axes[kEstimator].labels, one.estimator->id);
  }

  void add_errors(const char* name, const char* says, const char* unit,
                  double CaseRow::Recording::*number) {
    Variable& errors =
        add(name, says, unit, {kInput, kEstimator, kAmplitude, kFrequency, kReplicate});
    for (const auto& [one, row] : cases_) {
      for (const CaseRow::Recording& recording : row->recordings) {
        if (!on_grid(*one, recording)) continue;
        const std::size_t a = index_in(table_.axes[kAmplitude].values, tidy(recording.amplitude));
        const std::size_t f =
            index_in(table_.axes[kFrequency].values, tidy(recording.frequency_hz));
        at(errors, {input_of(*one), estimator_of(*one), a, f,
                    static_cast<std::size_t>(one->replicate)}) = recording.*number;
      }
    }
  }

  void add_parameters(const char* name, const char* says, double CaseRow::Parameter::*number) {
    Variable& variable = add(name, says, "", {kInput, kEstimator, kReplicate, kParameter});
    for (const auto& [one, row] : cases_) {
      for (const CaseRow::Parameter& parameter : row->parameters) {
        const std::size_t p = index_in(table_.axes[kParameter].labels, parameter.name);
        at(variable, {input_of(*one), estimator_of(*one), static_cast<std::size_t>(one->replicate),
                      p}) = parameter.*number;
      }
    }
  }

  void add_parameter_units() {
    Variable units{
        "parameter_unit", "units of the estimates", "", {kInput, kEstimator, kParameter}, {}, {}};
    const auto& [inputs, estimators, names] =
        std::tie(table_.axes[kInput], table_.axes[kEstimator], table_.axes[kParameter]);
    units.labels.resize(inputs.size() * estimators.size() * names.size());
    for (const auto& [one, row] : cases_) {
      for (const CaseRow::Parameter& parameter : row->parameters) {
        const std::size_t p = index_in(names.labels, parameter.name);
        const std::size_t pair = input_of(*one) * estimators.size() + estimator_of(*one);
        units.labels[pair * names.size() + p] = parameter.unit;
      }
    }
    table_.variables.push_back(std::move(units));
  }

  void add_rows() {
    Variable cases{"row_case", "key of the case", "", {kRow}, {}, {}};
    Variable ids{"row_recording", "id of the recording", "", {kRow}, {}, {}};
    Variable roles{"row_role", "train or holdout", "", {kRow}, {}, {}};
    Variable errors{"row_error_percent",
                    "rms error of torque (force), of the recording's peak",
                    "percent",
                    {kRow},
                    {},
                    {}};
    Variable absolute{"row_error", "rms error of torque (force), in the unit of row_error_unit",
                      "",          {kRow},
                      {},          {}};
    Variable units{"row_error_unit", "unit of the torque or force", "", {kRow}, {}, {}};
    for (const auto& [one, row] : cases_) {
      for (const CaseRow::Recording& recording : row->recordings) {
        absolute.values.push_back(recording.error);
        units.labels.push_back(row->linear ? "N" : "N m");
        cases.labels.push_back(one->key);
        ids.labels.push_back(recording.id);
        roles.labels.push_back(recording.role);
        errors.values.push_back(recording.error_percent);
      }
    }
    for (Variable* variable : {&cases, &ids, &roles, &errors, &absolute, &units})
      table_.variables.push_back(std::move(*variable));
  }

  const StudyPlan& plan_;
  std::vector<std::pair<const CasePlan*, const CaseRow*>> cases_;
  ResultsTable table_;
};

}  // namespace

ResultsTable gather_results(const StudyPlan& plan, std::span<const std::optional<CaseRow>> rows) {
  return Gatherer(plan, rows)();
}

}  // namespace flexspline::studies
