#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "flexspline/studies/case_row.hpp"
#include "flexspline/studies/plan.hpp"

namespace flexspline::studies {

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A dimension with its values.
struct Axis {
  std::string name;
  std::vector<std::string> labels;  ///< of a dimension of names
  std::vector<double> values;       ///< of a dimension of numbers
  std::string unit;
  std::string says{};
  bool integer = false;

  std::size_t size() const { return labels.empty() ? values.size() : labels.size(); }
};

/// A variable over dimensions named by their position in the table.
struct Variable {
  std::string name;
  std::string says;
  std::string unit;
  std::vector<std::size_t> axes;
  std::vector<double> values;       ///< row-major; empty for text
  std::vector<std::string> labels;  ///< text
};

struct ResultsTable {
  std::vector<Axis> axes;
  std::vector<Variable> variables;
};

/// The row of a case's artefact; none where the case failed.
std::optional<CaseRow> row_of(const nlohmann::ordered_json& artefact);

/// Gathers the table from the rows, which are as many as the plan's cases. What is missing stays
/// NaN.
ResultsTable gather_results(const StudyPlan& plan, std::span<const std::optional<CaseRow>> rows);

}  // namespace flexspline::studies
