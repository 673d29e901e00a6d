#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace flexspline::estimators {

/// A normal law cut off at bounds (infinite where there is none): what is left of an estimate's
/// law where the truth is known to lie within them.
struct BoundedNormal {
  Eigen::VectorXd mean;        ///< of the law before it is cut; may lie outside
  Eigen::MatrixXd covariance;  ///< positive definite
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
};

/// Draws, a row each, by Gibbs' sampler (Geweke 1991), from a start within the bounds; each is some
/// sweeps away from the last. The same seed gives the same draws.
Eigen::MatrixXd draws_of(const BoundedNormal& law, Eigen::VectorXd start, Eigen::Index count,
                         std::uint64_t seed);

}  // namespace flexspline::estimators
