#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace flexspline::estimators {

/// A normal law cut off at bounds (infinite where there is none): what is left of an estimate's
/// law where the truth is known to lie within them.
struct BoundedNormal {
  Eigen::VectorXd mean;        ///< of the law before it is cut; may lie outside
  Eigen::MatrixXd covariance;  ///< positive definite but for parameters without a variance
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
};

/// Draws, a row each, by Gibbs' sampler (Geweke 1991), from a start within the bounds; each is some
/// sweeps away from the last. A parameter whose row of the covariance is zero stays at its start.
/// The same seed gives the same draws. Empty where the covariance of the others is not positive
/// definite.
Eigen::MatrixXd draws_of(const BoundedNormal& law, Eigen::VectorXd start, Eigen::Index count,
                         std::uint64_t seed);

}  // namespace flexspline::estimators
