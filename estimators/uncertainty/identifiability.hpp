#pragma once

#include <vector>

#include <Eigen/Core>

namespace flexspline::estimators {

/// Largest cosine between a direction of the columns `of` and one of the columns `rest`: 1 when
/// something of `of` can be imitated without a trace.
double largest_cosine(const Eigen::MatrixXd& of, const Eigen::MatrixXd& rest);

/// Condition number with all columns scaled to length one; columns of zeros are left out. Infinite
/// where nothing is left, or fewer rows than columns.
double scaled_condition(const Eigen::MatrixXd& jacobian);

}  // namespace flexspline::estimators
