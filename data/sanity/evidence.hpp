#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace flexspline::data {

/// A number that should be near 1, of one recording.
struct Factor {
  std::string recording;
  double value = 1.0;
};

/// What factors say together: the one that all share, and those of recordings that differ from it.
struct Agreement {
  double common = 1.0;  ///< the median
  std::vector<Factor> others;
};

/// others: those that differ from the median by more than a factor of most.
Agreement agreement_of(const std::vector<Factor>& factors, double most);

/// True where a factor differs from 1 by more than a factor of most; a negative one always does.
bool is_off(double factor, double most);

/// "57.3 is degrees taken as radians": the mistake that would give a factor, to 12 %; empty where
/// none does. ratio: of the gear, or NaN.
std::string mistake_of(double factor, double ratio);

/// Least squares of y on columns over the rows that count.
struct Regression {
  Eigen::VectorXd coefficient;
  Eigen::VectorXd error;   ///< standard errors, of white residuals
  double explained = 0.0;  ///< share of the variance of y
  double freedom = 1.0;    ///< rows less columns
};
Regression regression(const std::vector<Eigen::ArrayXd>& columns, const Eigen::ArrayXd& y,
                      const Eigen::ArrayXd& usable);

/// True where a column held at a value would leave more than twice the sum of squares. What a
/// regression's form does not follow is no noise: along columns that are much alike it moves
/// coefficients far beyond their standard errors, and leaves as much as it moves.
bool refutes(const Regression& fit, Eigen::Index column, double value);

/// x / sqrt(x^2 + width^2), the width a fifth of the rms.
Eigen::ArrayXd smooth_sign(const Eigen::ArrayXd& x);

}  // namespace flexspline::data
