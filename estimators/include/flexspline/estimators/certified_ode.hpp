#pragma once

#include <span>
#include <string>
#include <vector>

#include "flexspline/estimators/ode_fit.hpp"

namespace flexspline::estimators {

/// A published estimation problem with its optimum, for the selftest and the tests. Residuals have
/// sigma 1; sums of squares are twice the cost of a fit.
struct CertifiedOde {
  std::string name;
  std::string title;
  std::string source{};
  OdeFitProblem problem{};
  double published_sum = kNotComputed;   ///< as printed, on the publisher's mesh
  double sum_of_squares = kNotComputed;  ///< of the exact solution of the law, found independently
  std::vector<double> parameters{};      ///< of the system, at the optimum
  std::vector<double> std{};  ///< of parameters by Student's law; NaN on a bound or not published
};

/// All of them, by file name.
std::span<const CertifiedOde> certified_odes();

}  // namespace flexspline::estimators
