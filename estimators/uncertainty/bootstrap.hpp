#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/least_squares.hpp"

namespace flexspline::estimators {

/// Where the noise of a replicate comes from: the normal law, or the residuals themselves in blocks
/// of random length (stationary bootstrap of Politis and Romano, 1994), which keeps their colour.
enum class Resampling { parametric, block };

/// Rows of the problem that are one time series, in order.
using NoiseSeries = std::vector<std::size_t>;

struct BootstrapSettings {
  Resampling resampling = Resampling::parametric;
  std::size_t replicates = 200;
  std::uint64_t seed = 1;
  double block_length = 0.0;  ///< mean, in rows; 0: from the residuals of each series
  bool noise_known = false;   ///< residuals have variance 1; else it is estimated
  double level = 0.95;
  std::vector<NoiseSeries> series{};  ///< empty: each block of the problem is one
  SolverSettings solver{.function_tolerance = 1e-10, .parameter_tolerance = 1e-10};
};

struct Bootstrap {
  Eigen::MatrixXd replicate;    ///< a row each
  Eigen::MatrixXd covariance;   ///< about their mean
  std::vector<double> lower{};  ///< percentiles
  std::vector<double> upper{};
  std::size_t failed = 0;              ///< replicates that could not be fitted, left out
  std::vector<double> block_length{};  ///< of each series; empty for the parametric one
};

/// Block length that costs the least error in a mean, for a process of first order with the lag-one
/// correlation of the series: (2 |rho|/(1 - rho^2))^(2/3) n^(1/3), at least 1 (Politis and White
/// 2004, corrected 2009).
double stationary_block_length(std::span<const double> series);

/// Fits the problem again to its own prediction at p plus drawn noise, from p; the replicates of a
/// seed do not depend on how many there are. Series are drawn independently of each other.
/// Not modelled: correlation between series, noise that depends on the parameters.
/// Errors: numerics, where p cannot be evaluated or most replicates cannot be fitted.
Result<Bootstrap> bootstrap(const LeastSquaresProblem& problem,
                            std::span<const BoundedParameter> parameters, std::span<const double> p,
                            const BootstrapSettings& settings);

}  // namespace flexspline::estimators
