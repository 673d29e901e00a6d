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

/// What Ipopt takes for second derivatives: J'J of the exact Jacobian, or what it gathers on its
/// way.
enum class Curvature { gauss_newton, limited_memory };

struct SolverSettings {
  int max_iterations = 60;
  double function_tolerance = 1e-7;   ///< relative fall of the cost that ends the fit
  double parameter_tolerance = 1e-9;  ///< relative step that ends the fit; Ceres alone
  /// Largest entry of J'r, in scaled parameters, that ends the fit; in Ipopt over the start's cost.
  double gradient_tolerance = 1e-14;
  double trust_radius = 1e4;  ///< of the first step: 1/Levenberg-Marquardt's damping
  /// Least damping of a parameter as a share of what its derivatives at the start ask for. 1 keeps
  /// parameters that lose their effect on the way from running off to a plateau.
  double damping_floor = 1e-6;
  int threads = 1;  ///< for the blocks; Ceres alone
  /// Derivatives are evaluated with the residuals of a trial point, so that one is rejected which
  /// has none; without, such a point ends the fit once it is accepted. Ceres alone.
  bool slopes_at_trials = false;
  /// Fall of the cost that a step promises below which the fit ends: of residuals in noises, d
  /// standard deviations from the minimum promise d^2/2, whatever an integrator adds to the cost.
  /// Ceres alone.
  double promise = 0.0;
  Curvature curvature = Curvature::gauss_newton;  ///< Ipopt alone
};

/// Residuals and Jacobian of all blocks, one below the other.
struct Linearisation {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
};

struct LeastSquaresSolution {
  std::vector<double> p;
  double cost = kNotComputed;  ///< half the sum of squares
  Termination termination = Termination::not_run;
  int iterations = 0;
  long evaluations = 0;
  std::vector<bool> bound_active;
  Linearisation at{};  ///< at p; of Ceres alone
};

/// Minimises half the sum of squares within bounds: Levenberg-Marquardt of Ceres, dense QR.
/// Errors: numerics when the start cannot be evaluated, with the block's reason.
Result<LeastSquaresSolution> minimise(const LeastSquaresProblem& problem,
                                      std::span<const BoundedParameter> parameters,
                                      const SolverSettings& settings);

/// The same by the interior-point method of Ipopt, with a line search on the cost over its value at
/// the start and damped as Levenberg and Marquardt do (damping.hpp). One solve at a time in the
/// process (ipopt_session.hpp); blocks one by one. no_progress: rounding hid the way down.
/// Errors: numerics, with the block's reason or the parameters that gave no numbers.
Result<LeastSquaresSolution> minimise_ipopt(const LeastSquaresProblem& problem,
                                            std::span<const BoundedParameter> parameters,
                                            const SolverSettings& settings);

/// The error of residuals that are no numbers, with the parameters they came from.
Error not_a_number(std::span<const double> p);

/// Errors: numerics, with the parameters, where a block fails or a residual is no number.
Result<double> half_sum_of_squares(const LeastSquaresProblem& problem, std::span<const double> p);

/// At p.
Result<Linearisation> linearise(const LeastSquaresProblem& problem, std::span<const double> p);

}  // namespace flexspline::estimators
