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

/// Rows without which the whole search is done once more.
struct OuterFold {
  Eigen::ArrayXd rows;
  bool proves = true;  ///< they are judged; else the search without them only has a say in names
};

/// The same rows in three folds at most, for what is dear to do in each. Where the data set marks
/// what is held out, which is one fold, recordings that it does not mark, dealt out as they would
/// be without marks, make up the rest: what a name hangs on is not what somebody has marked.
std::vector<OuterFold> outer_folds(const Frame& frame);

/// The recordings without the rows of a fold, as if these were not there: whole ones are gone, of
/// others the end.
RecordingSet without_rows(const RecordingSet& set, const Frame& frame, const Eigen::ArrayXd& fold);

}  // namespace flexspline::studies
