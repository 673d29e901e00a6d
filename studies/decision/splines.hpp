#pragma once

#include <Eigen/Core>

namespace flexspline::studies::decision {

/// Uniform cubic B-splines of x over [-1, 1] (symmetric ones: odd or even sums of mirror images),
/// held at the ends.
Eigen::MatrixXd spline(const Eigen::ArrayXd& x, int intervals);
Eigen::MatrixXd odd_spline(const Eigen::ArrayXd& x, int intervals);
Eigen::MatrixXd even_spline(const Eigen::ArrayXd& x, int intervals);

/// Hat functions over [0, 1], count of them.
Eigen::MatrixXd hats(const Eigen::ArrayXd& x, int count);

/// Products of every column with every column.
Eigen::MatrixXd products(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// asinh(x/core)/asinh(range/core): fine where x is small.
Eigen::ArrayXd compressed(const Eigen::ArrayXd& x, double core, double range);

/// Less its mean over the rows that count.
void centre(Eigen::MatrixXd& columns, const Eigen::ArrayXd& usable);

}  // namespace flexspline::studies::decision
