#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {

/// A formula of at most three products of powers, signs and (of a motor's angle) sines, SI, that
/// follows nine tenths of a table's mean square: "tau += 35.2 phi w". Terms are taken one by one,
/// the best first. Empty where there is none.
/// values: at the knots, the last axis fastest; occupation: share of the recordings at each.
std::string form_of(const std::vector<TableAxis>& axes, const Eigen::VectorXd& values,
                    const Eigen::VectorXd& occupation);

}  // namespace flexspline::studies
