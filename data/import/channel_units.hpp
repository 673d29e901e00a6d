#pragma once

#include <optional>
#include <string_view>

#include "flexspline/core/rig.hpp"
#include "import/column_roles.hpp"
#include "import/import_parts.hpp"

namespace flexspline::data {

/// What a role is called on a rig; where it has none there, nothing.
std::optional<Quantity> quantity_of(const ColumnMeaning& one, Rig rig);

/// The unit that an option would state for a quantity.
std::string_view usual_unit(const QuantityInfo& info);

/// Finds the unit where the file has none: of marks, which need none, and of time, of which one
/// unit may give a rate that benches have.
void find_unit_of(Quantity quantity, const TableSurvey& table, std::size_t column,
                  ColumnRole& role);

}  // namespace flexspline::data
