#pragma once

#include <string>

#include "ode_fit/layout.hpp"

namespace flexspline::estimators {

/// Which further recording would tell most of a combination of the unknowns (changes relative to
/// their sizes), in words with the factor by which its standard deviation falls.
std::string helpful_recording(const OdeLayout& layout, std::span<const double> q,
                              const Eigen::MatrixXd& free, const Eigen::MatrixXd& jacobian,
                              const Eigen::VectorXd& combination, const std::vector<double>& sizes);

}  // namespace flexspline::estimators
