#pragma once

#include "decision/fit.hpp"

namespace flexspline::studies::decision {

/// A frame on which a model is to be judged, measured by the scales of that on which it was
/// fitted.
Frame to_scale_of(Frame frame, const Frame& fitted);

/// Prediction of the measured torque of an equation by baseline and causes alone, all rows.
/// Mountings with zeros of their own that were not fitted are counted from where the model fits
/// them best, one number a recording.
Eigen::ArrayXd predicted(const Frame& frame, const Frame& fitted, const DriveState& state,
                         Equation equation);

}  // namespace flexspline::studies::decision
