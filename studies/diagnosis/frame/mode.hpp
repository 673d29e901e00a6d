#pragma once

#include "diagnosis/frame/frame.hpp"

namespace flexspline::studies {

/// A mode that rings, q'' + 2 z w q' + w^2 q = w^2 u.
struct Mode {
  double frequency = 0.0;  ///< w, rad/s
  double damping = 0.0;    ///< z, below 1
};

/// How it differs from what drives it, by row.
struct ModeAnswer {
  Eigen::ArrayXd place;  ///< q - u
  Eigen::ArrayXd speed;  ///< q'/w
};

/// Exact for u linear between rows, which are taken as evenly spaced within a recording; at rest at
/// the start of every recording.
ModeAnswer answer_of(const Frame& frame, const Eigen::ArrayXd& u, const Mode& mode);

}  // namespace flexspline::studies
