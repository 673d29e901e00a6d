#pragma once

#include <numbers>

#include "diagnosis/frame/frame.hpp"

namespace flexspline::studies {

inline constexpr double kTurn = 2.0 * std::numbers::pi;            ///< rad
inline constexpr double kMostDamping = 0.5 * std::numbers::sqrt2;  ///< with more it has no peak

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

/// rad/s, between which rows tell a mode from the motion that it follows: 1/longest_lag, and five
/// rows a period, between which a line misses 19 % of a sine at most.
double slowest_mode(const Frame& frame);
double fastest_mode(const Frame& frame);

}  // namespace flexspline::studies
