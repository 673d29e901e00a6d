#pragma once

#include "diagnosis/gap_in_spring.hpp"

namespace flexspline::studies {

/// What was found in a frame, and proved.
struct Finding {
  Frame frame;  ///< the motion counted as the model fits it best, with notes
  Selection selection;
  Proof proof;
};

/// Causes beside a baseline with a free f, proved on recordings held out; where that may hide a gap
/// (may_hide_a_gap), beside a firm spring too, which stands where it tells one.
/// Errors: those of the fits.
Result<Finding> find_causes(Frame frame, const Limits& limits,
                            const std::function<void(double, std::string_view)>& progress);

}  // namespace flexspline::studies
