#pragma once

#include <array>
#include <string>
#include <vector>

#include "flexspline/core/estimate.hpp"

namespace flexspline::estimators {

/// torque = J a + B v + c tanh(v/w) along the rows of a shaft, SI.
struct ShaftEquation {
  bool dry = false;                  ///< it has c and w
  std::array<std::string, 4> names;  ///< of J, B, c and w
  std::vector<double> torque{}, speed{}, acceleration{};
  std::string absent{};  ///< why there are no rows
};

struct FittedConstant {
  ParameterEstimate estimate;
  bool identifiable = false;
};

/// Constants >= 0 by least squares, w by a search; J is not among them where it is stated and so
/// within the torque already.
std::vector<FittedConstant> fitted(const ShaftEquation& equation, bool inertia_stated);

}  // namespace flexspline::estimators
