#pragma once

#include <vector>

#include <Eigen/Core>

#include "flexspline/core/estimate.hpp"
#include "torsion/layout.hpp"

namespace flexspline::estimators {

/// The domain that recordings support.
struct Domain {
  double motion_from = kNotComputed;
  double motion_to = kNotComputed;
  double velocity = kNotComputed;
};

/// Where bands are drawn: evenly, to 1.3 times the domain so that the end of it can be seen.
std::vector<double> band_arguments(double from, double to);

/// Says that bands come from draws.
struct DrawnBands {};

/// Pointwise 95 % bands of f, g^-1 and (where free) h from the covariance of p, drawn to 1.3 times
/// the domain so that the end of it can be seen.
std::vector<FunctionBand> torsion_bands(const TorsionLayout& layout, std::span<const double> p,
                                        const Eigen::MatrixXd& covariance, const Domain& domain);

/// The same where coefficients lie on or near a bound: a symmetric band would count them as known.
/// Between the 2.5 and 97.5 % points of `draws` of p (a row each) from its law within the bounds,
/// and never without the estimate itself.
std::vector<FunctionBand> torsion_bands(const TorsionLayout& layout, std::span<const double> p,
                                        const Eigen::MatrixXd& draws, const Domain& domain,
                                        DrawnBands);

/// A band of one law whose coefficients have this covariance.
FunctionBand law_band(std::string function, const Law& law, const Eigen::MatrixXd& covariance,
                      double from, double to);

}  // namespace flexspline::estimators
