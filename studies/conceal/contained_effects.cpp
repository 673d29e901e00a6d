#include <algorithm>

#include "flexspline/studies/conceal.hpp"

namespace flexspline::studies {

std::span<const ContainedEffect> contained_effects() {
  static const std::vector<ContainedEffect> rows = {
      {"soft_windup",
       {Rig::locked, Rig::free, Rig::specimen},
       "a stiffness that changes with the torsion, alike both ways, is f itself"},
      {"series_compliance",
       {Rig::locked, Rig::free, Rig::specimen},
       "a spring in series with f is a softer f; left is that its own torsion is not damped"},
      {"nonlinear_viscous_friction",
       {Rig::locked, Rig::free, Rig::servo},
       "drag by any odd rising law of the rate is g^-1; at a motor, viscous and dry friction "
       "follow it over the speeds that it has"},
      {"current_lag",
       {Rig::locked},
       "a motor torque that is late by milliseconds is, to the first order, viscous friction"},
      {"torque_constant_error",
       {Rig::servo},
       "inertia, gravity and frictions are all unknown: a common scale is theirs"},
  };
  return rows;
}

std::vector<std::string> contained_on(data::BenchKind rig) {
  std::vector<std::string> ids;
  if (rig.travels) return ids;
  for (const ContainedEffect& row : contained_effects()) {
    if (std::ranges::find(row.rigs, rig.rig) != row.rigs.end()) ids.emplace_back(row.effect);
  }
  return ids;
}

}  // namespace flexspline::studies
