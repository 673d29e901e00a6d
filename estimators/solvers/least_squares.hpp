#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "flexspline/core/error.hpp"
#include "flexspline/core/estimate.hpp"

namespace flexspline::estimators {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct BoundedParameter {
  double start = 0.0;
  double lower = 0.0;
  double upper = 0.0;
  double scale = 1.0;  ///< typical size; the solver works on parameter / scale
};

/// Residual blocks r_b(p) with exact Jacobians. Blocks are evaluated in parallel.
class LeastSquaresProblem {
 public:
  virtual ~LeastSquaresProblem() = default;

  virtual std::size_t blocks() const = 0;
  virtual std::size_t residuals(std::size_t block) const = 0;
  /// jacobian is residuals x parameters, row by row, or empty where it is not wanted.
  /// Errors: numerics where this p cannot be simulated; the solver then takes a shorter step.
  virtual Result<void> evaluate(std::size_t block, std::span<const double> p,
                                std::span<double> residual, std::span<double> jacobian) const = 0;
};

struct SolverSettings {
  int max_iterations = 60;
  double function_tolerance = 1e-7;
  double parameter_tolerance = 1e-9;
  int threads = 1;
};

struct LeastSquaresSolution {
  std::vector<double> p;
  double cost = kNotComputed;  ///< half the sum of squares
  Termination termination = Termination::not_run;
  int iterations = 0;
  long evaluations = 0;
  std::vector<bool> bound_active;
};

/// Minimises half the sum of squares within bounds: Levenberg-Marquardt of Ceres, dense QR.
/// Errors: numerics when the start cannot be evaluated, with the block's reason.
Result<LeastSquaresSolution> minimise(const LeastSquaresProblem& problem,
                                      std::span<const BoundedParameter> parameters,
                                      const SolverSettings& settings);

/// Residuals and Jacobian of all blocks, one below the other, at p.
struct Linearisation {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
};
Result<Linearisation> linearise(const LeastSquaresProblem& problem, std::span<const double> p);

}  // namespace flexspline::estimators
