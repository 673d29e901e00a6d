#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flexspline/data/import.hpp"
#include "import/column_words.hpp"
#include "import/survey.hpp"

namespace flexspline::data {

/// What a column is, before the rig is known.
struct ColumnRole {
  ColumnMeaning meaning;
  std::optional<Unit> unit;
  Certainty certainty = Certainty::sure;
  std::string evidence;
};

/// A straight line through the samples of two columns, x over y.
struct SlopeFit {
  double slope = 0.0;
  double explained = 0.0;  ///< share of the variance of y
};
SlopeFit fit_slope(const std::vector<double>& x, const std::vector<double>& y);

/// By name, unit and, where two angles have no side, behaviour: what turns more is the motor's.
std::vector<ColumnRole> column_roles(const TableSurvey& table);

/// The column of time: marked by the file, named, of its unit, or the only one that rises evenly.
/// Nothing where there is none.
std::optional<std::size_t> find_time(const TableSurvey& table, std::vector<ColumnRole>& roles);

/// "column 4 'Drehmoment' [mNm]".
std::string column_in_words(const TableSurvey& table, std::size_t column);
/// All of a table.
std::string columns_in_words(const TableSurvey& table);

}  // namespace flexspline::data
