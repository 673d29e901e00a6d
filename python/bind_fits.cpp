#include <pybind11/stl.h>

#include <nlohmann/json.hpp>

#include "bindings.hpp"
#include "flexspline/core/torsion_record.hpp"
#include "flexspline/data/estimate_json.hpp"
#include "flexspline/estimators/method.hpp"
#include "flexspline/studies/diagnosis.hpp"
#include "flexspline/studies/diagnosis_json.hpp"

namespace py = pybind11;

namespace flexspline::python {
namespace {

/// The artefact as text, and the model.
using Outcome = std::pair<std::string, std::optional<RigModel>>;

estimators::FitProblem problem_of(const RecordingSet& set, const std::vector<std::string>& train,
                                  const estimators::Options& options) {
  estimators::FitProblem problem;
  problem.options = options;
  for (TorsionRecord& record : value_of(torsion_records(set))) {
    if (std::ranges::find(train, record.id) != train.end()) {
      problem.records.push_back(std::move(record));
    }
  }
  return problem;
}

Outcome fit(const RecordingSet& set, const std::string& method,
            const std::vector<std::string>& train, const std::map<std::string, double>& numbers,
            const std::map<std::string, std::string>& words) {
  const auto* row = value_of(estimators::find_method(method));
  const estimators::Options options{numbers, words};
  value_of(estimators::check_options(*row, options));
  const auto result = std::make_shared<Result<Estimate>>();
  interruptible(
      [result, row, problem = problem_of(set, train, options)] { *result = row->fit(problem); });
  const Estimate estimate = value_of(std::move(*result));
  RigModel model;
  model.rig = Rig::specimen;
  model.drive.torsion = estimate.model;
  return {data::to_json(estimate, set.display).dump(), std::move(model)};
}

Outcome diagnose(const RecordingSet& set, unsigned threads, std::vector<std::string> holdout,
                 bool nested) {
  const auto result = std::make_shared<Result<studies::Diagnosis>>();
  const studies::DiagnosisSettings settings = {threads, std::move(holdout), nested};
  interruptible([result, set, settings] { *result = studies::diagnose(set, {}, settings); });
  const studies::Diagnosis diagnosis = value_of(std::move(*result));
  return {studies::to_json(diagnosis).dump(), diagnosis.model};
}

std::vector<std::string> estimator_ids() {
  std::vector<std::string> ids;
  for (const auto& row : estimators::methods()) ids.emplace_back(row.id);
  return ids;
}

}  // namespace

void bind_fits(py::module_& module) {
  module.def("fit", &fit, py::arg("recordings"), py::arg("estimator"), py::arg("train"),
             py::arg("numbers"), py::arg("words"));
  module.def("diagnose", &diagnose, py::arg("recordings"), py::arg("threads"),
             py::arg("holdout"), py::arg("nested"));
  module.def("estimators", &estimator_ids);
}

}  // namespace flexspline::python
