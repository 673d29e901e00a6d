#pragma once

#include <map>
#include <string>
#include <vector>

namespace flexspline::studies {

/// What tables, results.nc and answers ask of a case: kept beside its artefact. NaN where there is
/// none.
struct CaseRow {
  struct Parameter {
    std::string name;
    double value = 0.0;  ///< SI, or as scaled by its law
    double std = 0.0;
    std::string unit{};
  };
  struct Recording {
    std::string id;
    std::string role;  ///< "train" or "holdout"
    double amplitude = 0.0;
    double frequency_hz = 0.0;
    double error_percent = 0.0;   ///< against the truth where one is known, else what was measured
    double error = 0.0;           ///< the same, Nm (N)
    bool outside_domain = false;  ///< beyond what was trained on
  };
  bool linear = false;  ///< errors are forces, N
  std::vector<Parameter> parameters;
  std::vector<Recording> recordings;
  std::map<std::string, double> numbers;             ///< docs/artefacts.md, "rows"
  std::map<std::string, std::vector<double>> lists;  ///< the same

  /// NaN where there is none of that name.
  double number(const std::string& name) const;
};

}  // namespace flexspline::studies
