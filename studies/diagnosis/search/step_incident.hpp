#pragma once

#include <optional>

#include "diagnosis/search/selection.hpp"

namespace flexspline::studies {

/// A torque that is another from one row of a recording to its end.
struct Step {
  std::size_t segment = 0;
  Eigen::Index first = 0;  ///< row of the recording; its tenths at either end are not tried
  double nats = 0.0;       ///< half the fall of the chi square, with all of the model fitted to it
};

/// The best step in one equation, where it is all that is missing (limits.alike() of the misfit
/// beyond noise): any smooth misfit of one recording has a step that gains something. Its row is
/// found by halving from a grid, its height with everything that the model takes of it, to first
/// order (Linearised): what a model has fitted to a step is none in its residual. Recordings
/// without misfit beyond noise are not searched. None where none is.
std::optional<Step> step_taken(const Frame& frame, const Findings& findings, Equation equation,
                               const Limits& limits);

}  // namespace flexspline::studies
