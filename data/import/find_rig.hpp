#pragma once

#include <optional>
#include <string>
#include <vector>

#include "import/column_roles.hpp"

namespace flexspline::data {

/// The bench that a table is of, by what it records and what moves; nothing where that may be
/// several.
struct RigGuess {
  Rig rig = Rig::locked;
  std::string evidence;
};
std::optional<RigGuess> find_rig_of(const TableSurvey& table, const std::vector<ColumnRole>& roles,
                                    const std::vector<ColumnChoice>& choices);

/// Motor turns per output turn from both angles; nothing where the load does not follow the motor.
struct RatioGuess {
  double ratio = 0.0;  ///< its sign is that of the slope
  std::string evidence;
};
std::optional<RatioGuess> find_ratio(const TableSurvey& table, std::size_t motor, double motor_unit,
                                     std::size_t load, double load_unit);

}  // namespace flexspline::data
