#pragma once

#include <optional>
#include <vector>

#include "diagnosis/search/search.hpp"

namespace flexspline::studies {

/// A ripple over the motor's angle in what is left of a joint's steady strokes.
struct Ripple {
  double order = 0.0;      ///< a turn of the motor
  double statistic = 0.0;  ///< as that of a coordinate, of fast changes alone
  double share = 0.0;      ///< of those, in the mean over rows
  double amplitude = 0.0;  ///< the largest of a recording and direction, Nm
  std::size_t segment = 0;
  double from_s = 0.0;  ///< the longest stroke of that recording and direction
  double to_s = 0.0;
};

/// The strongest ripple of an angle that travels. Only the residual about a running parabola of 51
/// samples is looked at, and of it what lies within four of its typical size (1.48 times the
/// median): reversals, which may leave hundred times as much, have no say. Amplitude and phase are
/// those of each recording and direction: what winds the joint up passes it differently at every
/// speed. A line of its
/// own in the spectrum. Orders from two periods in the window to 2.5 samples a period. None on
/// other rigs.
std::optional<Ripple> ripple_left(const Frame& frame, const Findings& findings);

/// Orders a turn of the motor that the travel tells apart: one period over all of it.
double resolved_order(const Frame& frame);

/// What recordings say of a ripple whose order they had no part in finding.
struct RippleProof {
  double ratio = 1.0;  ///< of their fast changes, root mean square without the ripple over with it
  double statistic = 0.0;               ///< summed over them
  std::vector<std::size_t> recordings;  ///< those that have a line of their own there
};

/// The order from all recordings but one, held against that one; amplitude and phase are its own.
/// None where no recording confirms what the others tell.
std::optional<RippleProof> prove_ripple(const Frame& frame, const Findings& findings);

}  // namespace flexspline::studies
