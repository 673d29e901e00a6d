#pragma once

#include <string>
#include <vector>

#include "flexspline/core/lane_kernels.hpp"
#include "torque_driven/gauss_newton.hpp"
#include "torque_driven/series.hpp"

namespace flexspline::estimators {

struct DrivenSettings {
  double tolerance = 1e-5;  ///< largest error of the integration, over the peak of each recording
  int max_iterations = 100;
  InstructionSet instructions = best_instruction_set();
};

/// What a way of fitting found.
struct DrivenFit {
  std::vector<double> p;
  NormalEquations at;
  Termination termination = Termination::not_run;
  int iterations = 0;
  long evaluations = 0;
  double integration_error = kNotComputed;  ///< largest, over the peak of its recording
  std::vector<std::string> notes{};
};

/// Single shooting from p by the kernels. Each recording has steps of its own, explicit or, where
/// that would take many, implicit; they are refined until solutions with half the step differ by no
/// more than the tolerance.
DrivenFit fit_by_kernels(const DrivenProblem& problem, std::vector<double> p,
                         const DrivenSettings& settings, std::size_t threads);

/// Single shooting from p by CVODES with forward sensitivities: an independent integrator, with the
/// tolerance on each step.
DrivenFit fit_by_cvodes(const DrivenProblem& problem, std::vector<double> p,
                        const DrivenSettings& settings, std::size_t threads);

/// Trajectory and coefficients at once by Ipopt: the motions at all samples are unknowns, and the
/// derivative of the polynomial through five neighbours obeys the law at each sample.
/// Errors: numerics, where Ipopt gives up.
Result<DrivenFit> fit_by_collocation(const DrivenProblem& problem, std::vector<double> p,
                                     const DrivenSettings& settings, std::size_t threads);

}  // namespace flexspline::estimators
