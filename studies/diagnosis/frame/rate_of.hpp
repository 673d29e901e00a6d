#pragma once

#include <Eigen/Core>

#include "diagnosis/frame/frame.hpp"

namespace flexspline::studies {

/// Central differences by time; 0 at the ends of a recording.
Eigen::ArrayXd rate_of(const Frame& frame, const Eigen::ArrayXd& signal);

}  // namespace flexspline::studies
