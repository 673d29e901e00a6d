#pragma once

#include <optional>
#include <string>

#include "diagnosis/frame/frame.hpp"

namespace flexspline::studies {

/// A recorded velocity that is the slope of the recorded angle behind filters:
/// (T d/dt + 1)^n w = dq/dt. It is read off the motion alone, and so is evidence of the instrument
/// that no fit to the torque has a part in.
struct VelocityLag {
  int filters = 1;             ///< n, one or two
  double time_constant = 0.0;  ///< T of each, s
  double before = 0.0;         ///< root mean square of w - dq/dt over that of dq/dt
  double after = 0.0;          ///< the same with the filters
};

/// The n and T that leave least, T up to the longest time constant that is looked for. None where
/// no velocity was recorded, where it differs by less than 1 %, or where filters leave more than
/// half of what a mere scale does (unit, sign or noise of the velocity then differ; which is not
/// told).
std::optional<VelocityLag> velocity_lag(const Frame& frame);

std::string in_words(const VelocityLag& lag);

}  // namespace flexspline::studies
