#pragma once

#include <vector>

#include <Eigen/Core>

#include "diagnosis/frame.hpp"

namespace flexspline::studies {

/// Rows that are held out together, 1 in each; every fold is judged by a fit to all other rows.
/// Whole recordings: those that the data set marks, in one fold; without marks each recording that
/// reaches furthest in nothing, torsion, rate, speed or torque (no law is judged where it has not
/// been fitted), dealt out in the order of their fastest motion into folds of a third of all
/// recordings at most. Where every recording reaches furthest in something, the last third of each
/// but for what reaches further than the rest, which is fitted.
std::vector<Eigen::ArrayXd> folds_of(const Frame& frame);

/// All rows that are held out in some fold.
Eigen::ArrayXd held_out(const Frame& frame);

}  // namespace flexspline::studies
