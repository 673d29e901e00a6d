#pragma once

#include <vector>

#include "diagnosis/frame/frame.hpp"

namespace flexspline::studies {

/// Rows with those of another cycle that are compared at least: a variance to 14 %.
inline constexpr Eigen::Index kFewestCompared = 100;

/// The first return of a motion to where its last rows were, which misses by no more than half a
/// row's way, and how many rows at the end follow those a cycle before: a motion that is eased in
/// repeats later. None where fewer than kFewestCompared rows do.
Repeat repeat_of(const Eigen::ArrayXd& motion);

/// What a residual does not repeat from one cycle to the next, over the root of two: noise,
/// whatever a model misses of a motion that repeats. Segments whose motion does not are empty; rows
/// that cannot be compared are NaN.
std::vector<Eigen::ArrayXd> unrepeated(const Frame& frame, const Eigen::ArrayXd& residual);

}  // namespace flexspline::studies
