#pragma once

#include "import/column_roles.hpp"
#include "import/import_parts.hpp"

namespace flexspline::data {

/// The channels of a table for a rig: what a person chose, then what its columns are. What the rig
/// needs and is not there, is there twice or has no unit becomes a question.
TableFinding find_channels(const TableSurvey& table, std::vector<ColumnRole> roles, Rig rig,
                           const std::vector<ColumnChoice>& choices);

}  // namespace flexspline::data
