#pragma once

#include "diagnosis/frame/frame.hpp"

namespace flexspline::studies {

/// Where the motion of a recording has corners: rows within ten of a change of the motor's
/// acceleration in a row that is six times the middle one. There its acceleration is not known,
/// nor is what follows from it. Rows are counted from the recording's first.
class Corners {
 public:
  Corners(const Frame& frame, const Segment& recording);

  bool at(Eigen::Index row) const { return touched(row, 1); }
  /// Whether there is one among these rows, or so many further.
  bool touched(Eigen::Index first, Eigen::Index count, Eigen::Index further = 0) const;
  /// Largest change of the acceleration in a row, rad/s2.
  double sharpest(Eigen::Index first, Eigen::Index count) const;
  Eigen::Index rows() const { return sharpness_.size(); }

 private:
  Eigen::ArrayXd sharpness_;  ///< by row, within ten of it
  Eigen::ArrayXd count_;      ///< running, of rows at a corner
};

}  // namespace flexspline::studies
