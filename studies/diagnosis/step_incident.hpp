#pragma once

#include <vector>

#include "diagnosis/selection.hpp"

namespace flexspline::studies {

/// A torque that is another from one row of a recording to its end.
struct Step {
  Eigen::Index first = 0;  ///< row of the recording; its tenths at either end are not tried
  double gain = 0.0;       ///< fall of the chi square, with all of the model fitted to it; 0: none
};

/// The best step of every recording in one equation: its row by halving from a grid, its height
/// with everything that the model may take of it, to first order (Linearised). What a model has
/// fitted to a step looks like none in its residual. Recordings with no misfit beyond noise are not
/// searched.
std::vector<Step> best_steps(const Frame& frame, const Findings& findings, Equation equation);

}  // namespace flexspline::studies
