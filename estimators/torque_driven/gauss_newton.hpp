#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "flexspline/core/estimate.hpp"

namespace flexspline::estimators {

/// Half the sum of squares at a point, its gradient J'r, and J'J.
struct NormalEquations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd gradient;
  double cost = kNotComputed;
  std::vector<double> squares{};  ///< [recording] what each adds to the sum of squares
};

/// Nothing where a point cannot be evaluated; the method then takes a shorter step.
using NormalEvaluation = std::function<std::optional<NormalEquations>(std::span<const double>)>;

struct GaussNewtonSettings {
  int max_iterations = 100;
  double decrease = 1e-10;  ///< expected of the next step, relative to the cost, that ends the fit
  double first_damping = 1e-3;
};

struct GaussNewtonResult {
  std::vector<double> p;
  NormalEquations at;
  Termination termination = Termination::not_run;
  int iterations = 0;
  long evaluations = 0;
};

/// Levenberg-Marquardt on the normal equations, each evaluated once a trial point. The columns are
/// scaled by their lengths; so half the digits of the Jacobian's condition are lost, which is 1e-8.
/// Returns failed, with the start, where that cannot be evaluated.
GaussNewtonResult gauss_newton(std::vector<double> start, const NormalEvaluation& evaluate,
                               const GaussNewtonSettings& settings);

}  // namespace flexspline::estimators
