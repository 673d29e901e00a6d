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

/// One fit of one of them.
struct CertifiedOdeRun {
  const CertifiedOde* problem = nullptr;
  OdeFitMethod method = OdeFitMethod::single_shooting;
  std::vector<double> parameters{};
  std::vector<double> parameter_digits{};
  double worst_digits = kNotComputed;  ///< of the system's parameters
  double worst_offset = kNotComputed;  ///< of a parameter off its bounds, in standard deviations
  double cost_digits = kNotComputed;
  double sum_of_squares = kNotComputed;
  int iterations = 0;
  double seconds = kNotComputed;
  Termination termination = Termination::not_run;
  std::string failure{};  ///< why there is no result

  /// The minimum to 6 digits, and every parameter within a hundredth of a standard deviation.
  bool passed() const;
};

inline constexpr double kRequiredOdeDigits = 6.0;

/// Fits the problem from its start. All problems are fitted with the same settings.
CertifiedOdeRun run_certified(const CertifiedOde& problem, OdeFitMethod method);

}  // namespace flexspline::estimators
