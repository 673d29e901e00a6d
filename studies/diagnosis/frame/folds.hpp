#pragma once

#include <vector>

#include <Eigen/Core>

#include "diagnosis/frame/frame.hpp"

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

/// The same rows in three folds at most, for what is dear to do in each.
std::vector<Eigen::ArrayXd> outer_folds(const Frame& frame);

/// The recordings without the rows of a fold, as if these were not there: whole ones are gone, of
/// others the end.
RecordingSet without_rows(const RecordingSet& set, const Frame& frame, const Eigen::ArrayXd& fold);

}  // namespace flexspline::studies
