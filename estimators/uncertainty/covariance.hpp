#pragma once

#include <span>
#include <vector>

#include "solvers/least_squares.hpp"

namespace flexspline::estimators {

/// Ratio of the long-run variance of a series to its variance: 1 for white noise, more where
/// neighbours agree. Newey and West (1987), bandwidth of Andrews (1991) for a first-order process.
double long_run_ratio(std::span<const double> series);

/// Sum over lags of the residual-weighted Jacobian, sum_t,s w(t-s) J_t r_t r_s J_s', a block at a
/// time: the middle of the sandwich for noise that is coloured within a recording.
Eigen::MatrixXd score_covariance(const LeastSquaresProblem& problem, const Linearisation& at);

/// N^-1 M N^-1 with N = J'J, over the parameters that are not on a bound; zero rows for those that
/// are. Directions without information get infinite variance.
Eigen::MatrixXd sandwich(const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& middle,
                         const std::vector<bool>& bound_active);

/// Standard deviation of gradient . p.
double standard_deviation(const Eigen::MatrixXd& covariance, std::span<const double> gradient);

}  // namespace flexspline::estimators
