#pragma once

#include <string>

#include "flexspline/core/effect.hpp"
#include "flexspline/core/estimate.hpp"
#include "flexspline/studies/metric.hpp"

namespace flexspline::studies {

/// Where a recording's motion has its zero, rad (m): 0 unless the estimate has a parameter
/// zero[<id>] for each training recording; then that recording's own, or for a recording that was
/// not trained on, of a data set, the zero of least squared error between measured and simulated
/// effort, sought over that recording's own range of motion. The virtual bench has one zero for
/// all its recordings: there it is the mean of the trained ones, and nothing is fitted.
Result<double> recording_zero(const Estimate& estimate, const std::string& id, const Motion& motion,
                              const ComparedSeries& series);

}  // namespace flexspline::studies
