#pragma once

#include <string>
#include <string_view>

#include "flexspline/core/units.hpp"

namespace flexspline::data {

/// What a column is by its name: in words of benches, English or German.
enum class ColumnKind {
  unknown,
  time,
  angle,
  torsion,
  displacement,
  velocity,
  torque,
  force,
  current,
  duty_cycle,
  voltage,
  temperature,
  enabled,
  valid,
};

enum class ColumnSide { unknown, motor, load };

struct ColumnMeaning {
  ColumnKind kind = ColumnKind::unknown;
  ColumnSide side = ColumnSide::unknown;
  bool commanded = false;
};

ColumnMeaning meaning_of_name(std::string_view name);

std::string_view name_of(ColumnKind kind);

/// The dimension that a kind's unit must have; a velocity may be linear, too.
bool may_have(ColumnKind kind, Dimension dimension);

/// The kind that only this dimension is of.
ColumnKind kind_of(Dimension dimension);

}  // namespace flexspline::data
