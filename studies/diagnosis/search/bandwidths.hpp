#pragma once

#include <vector>

#include "diagnosis/search/search.hpp"

namespace flexspline::studies {

/// Segment::bandwidth of every segment.
std::vector<std::size_t> bandwidths_of(const Frame& frame);

/// Bandwidths of the accelerations of the segments marked, by which a model, its parameters as they
/// are, leaves least of what was recorded, as root mean square over the rows that all of them let
/// be judged; that of the motion, where another leaves less by under 5 %. The others stay.
std::vector<std::size_t> bandwidths_for(const Frame& frame, const DriveModel& model,
                                        const std::vector<bool>& asked);

/// The same of all segments, by the model fitted anew behind the bandwidth, the same for all, by
/// which it is most likely: noise of an acceleration makes an inertia too small. A motion is
/// smoothed by cross-validation of its angle, to which a little noise of high frequency is nothing;
/// its acceleration has the frequency squared times as much. What the angle alone cannot tell, the
/// torque does: noise of counts, of time stamps and of samples that were interpolated moves
/// nothing. With causes in the model a bandwidth that hides one is worse.
std::vector<std::size_t> best_bandwidths(const Frame& frame, const Findings& model);

/// Which recordings' accelerations are behind other bandwidths than their motions.
std::string bandwidths_in_words(const Frame& frame);

}  // namespace flexspline::studies
