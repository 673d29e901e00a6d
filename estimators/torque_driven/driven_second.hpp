#pragma once

#include <span>
#include <vector>

#include "torque_driven/series.hpp"

namespace flexspline::estimators {

/// phi' at a point with its first and second derivatives by hand, for collocation.
struct DrivenDerivatives {
  double value = 0.0;
  double slope = 0.0;               ///< d/dx
  double bend = 0.0;                ///< d2/dx2
  std::vector<double> gradient{};   ///< d/dp
  std::vector<double> mixed{};      ///< d2/dp dx
  std::vector<double> curvature{};  ///< d2/dp dp, lower triangle row by row
};

enum class Derivatives { none, first, second };

/// Writes up to the order asked for; out keeps its memory.
void differentiate(const DrivenProblem& problem, std::span<const double> p, double torque, double x,
                   Derivatives order, DrivenDerivatives& out);

}  // namespace flexspline::estimators
