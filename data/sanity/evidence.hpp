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

/// Of one recording that does not agree with the others: true for a factor beyond most squared, or
/// near -1. Less, what it alone runs into does, too: a stop, a cable, a pendulum, which on a slow
/// motion outweigh an inertia and may turn its sign. Units, ratios and signs are further off.
bool is_mistaken_alone(double factor, double most);

/// Least squares of y on columns over the rows that count.
struct Regression {
  Eigen::VectorXd coefficient;
  Eigen::VectorXd error;   ///< standard errors, of white residuals
  double explained = 0.0;  ///< share of the variance of y
};
Regression regression(const std::vector<Eigen::ArrayXd>& columns, const Eigen::ArrayXd& y,
                      const Eigen::ArrayXd& usable);

/// The one whose first coefficient is nearer to a value, in the logarithm; one of its sign before
/// one of the other. What a regression's form does not follow moves coefficients far beyond their
/// standard errors, along columns that are much alike; a mistaken unit or sign shows with either.
Regression nearer_to(double value, Regression a, Regression b);

/// x / sqrt(x^2 + width^2), the width a fifth of the rms.
Eigen::ArrayXd smooth_sign(const Eigen::ArrayXd& x);

}  // namespace flexspline::data
