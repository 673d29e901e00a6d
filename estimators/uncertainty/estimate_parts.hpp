#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "flexspline/core/estimate.hpp"
#include "torsion/prepared_record.hpp"

namespace flexspline::estimators {

/// A parameter with its 95 % interval; on a bound it has a value and no interval.
ParameterEstimate parameter_estimate(std::string name, std::string unit, double value,
                                     double variance, bool bound_active);

/// Root mean square of the weighted residuals of every record, whose rows stand one record below
/// the other.
std::vector<RecordingFit> recording_fits(const std::vector<PreparedRecord>& records,
                                         const Eigen::VectorXd& residual);

}  // namespace flexspline::estimators
