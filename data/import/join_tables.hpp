#pragma once

#include <vector>

#include "flexspline/core/error.hpp"
#include "import/survey.hpp"

namespace flexspline::data {

/// Tables of one file, each on a clock of its own, as one table: at the instants of the slowest,
/// whose values stay as they are. What the others have there is found when rows are read
/// (JoinedRows); the survey has it from their samples. Columns whose name is in several tables are
/// called path/name. Errors: bad_data, where a clock has no known unit, falls or repeats, or fewer
/// than 16 rows overlap.
Result<TableSurvey> join_tables(const std::vector<const TableSurvey*>& tables);

/// The usual rate of a table's clock, Hz. Nothing where it has none of a known unit.
std::optional<double> rate_of(const TableSurvey& table);

/// y at x between the two samples around, linearly; that of a sample itself within a millionth of
/// the step. NaN outside and where the samples are further apart than `longest`.
struct Between {
  double value = 0.0;
  bool exact = false;
};
Between value_between(const std::vector<double>& x, const std::vector<double>& y, std::size_t next,
                      double at, double longest);

}  // namespace flexspline::data
