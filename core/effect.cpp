#include "flexspline/core/effect.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace flexspline {

std::string_view name_of(Site site) {
  switch (site) {
    case Site::motor:
      return "motor";
    case Site::load:
      return "load";
    case Site::transmission:
      return "transmission";
    case Site::kinematics:
      return "kinematics";
    case Site::torque_signal:
      return "torque_signal";
    case Site::motor_torque_signal:
      return "motor_torque_signal";
    case Site::motor_angle_signal:
      return "motor_angle_signal";
    case Site::load_angle_signal:
      return "load_angle_signal";
  }
  return "unknown";
}

Result<const EffectRow*> find_effect(std::string_view id) {
  const auto rows = effects();
  const auto row = std::ranges::find(rows, id, &EffectRow::id);
  if (row == rows.end()) {
    return failure(ErrorCode::bad_data, fmt::format("there is no effect '{}'", id),
                   "flexspline list effects names them");
  }
  return &*row;
}

Result<std::vector<double>> parameter_values(const EffectRow& row, const EffectSpec& spec) {
  const std::size_t group = row.parameters.size();
  const std::size_t given = spec.parameters.size();
  if (given == 0 || (row.repeats ? given % group != 0 : given != group)) {
    return failure(ErrorCode::bad_data, fmt::format("effect {} has {} parameters", row.id, given),
                   fmt::format("it takes {}{}", group, row.repeats ? " an element" : ""));
  }
  std::vector<double> values;
  for (const auto& [name, value] : spec.parameters) values.push_back(value);
  return values;
}

bool sought_by_law(const EffectRow& row) {
  using Role = ParameterSearch::Role;
  const auto has = [&](Role role) {
    return std::ranges::any_of(row.parameters,
                               [&](const EffectParameter& p) { return p.search.role == role; });
  };
  return has(Role::linear) && !has(Role::none);
}

std::size_t state_count(const EffectRow& row, std::size_t parameters) {
  return row.states * (row.repeats ? parameters / row.parameters.size() : 1);
}

}  // namespace flexspline
