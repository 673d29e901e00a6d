#pragma once

#include <string>
#include <vector>

#include "flexspline/estimators/uncertainty.hpp"
#include "uncertainty/bootstrap.hpp"
#include "uncertainty/profile.hpp"

namespace flexspline::estimators {

/// A least-squares fit as intervals need it.
struct FittedProblem {
  const LeastSquaresProblem& problem;
  std::span<const BoundedParameter> parameters;
  std::span<const double> p;
  const Eigen::MatrixXd& covariance;
  double variance = 1.0;                ///< of the residuals, at the minimum
  double quantile = 1.959963984540054;  ///< two-sided 95 %
  bool noise_known = false;
  std::vector<NoiseSeries> series{};  ///< of the residuals; empty: block by block
  double tolerance = 1e-6;            ///< of the ends of profiles
  std::vector<double> variances{};    ///< of the residuals, as each parameter\'s profile takes it;
                                      ///< empty: variance for all
};

struct Intervals {
  std::vector<double> std{};  ///< bootstrap alone; empty otherwise
  std::vector<double> lower{};
  std::vector<double> upper{};
  Eigen::MatrixXd covariance{};  ///< of the bootstrap's replicates; else empty
  std::vector<std::string>
      notes{};  ///< with how many replicates, how long the blocks, what is open
};

/// 95 % intervals of all parameters other than by their covariance. An interval that a bound cuts
/// ends there.
/// Errors: those of profile_interval and bootstrap.
Result<Intervals> intervals(const FittedProblem& fit, const UncertaintySettings& settings,
                            const SolverSettings& solver);

}  // namespace flexspline::estimators
