#pragma once

#include <string>
#include <vector>

#include "flexspline/core/model_spec.hpp"
#include "flexspline/estimators/method.hpp"

namespace flexspline::estimators {

/// A number of a model that may be fitted. Names as f[0], stribeck_friction.excess and, of effects
/// made of elements, presliding_hysteresis[1].yield.
struct GivenParameter {
  std::string name;
  std::string unit;
  double start = 0.0;
  double lower = 0.0;
  double upper = 0.0;
  bool held = false;
};

/// Every number of a model, in the order of parameters_of, with the bounds of its law or effect.
/// Held are those that `hold` names and `free` does not: a whole name, that of a law or an effect,
/// or an ending such as ".yield". Widths over which signs are rounded, and orders of harmonics, are
/// held unless they are freed.
/// Errors: bad_data, for an entry that names nothing and a start outside its bounds.
Result<std::vector<GivenParameter>> given_parameters(const GivenModel& given);

}  // namespace flexspline::estimators
