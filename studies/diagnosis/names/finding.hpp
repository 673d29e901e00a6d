#pragma once

#include "diagnosis/names/gap_in_spring.hpp"

namespace flexspline::studies {

/// What was found in a frame, and proved.
struct Finding {
  Frame frame;  ///< the motion counted as the model fits it best, with notes
  Selection selection;
  Proof proof;
};

/// Causes beside a baseline with a free f, proved on recordings held out; where that may hide a gap
/// (may_hide_a_gap), beside a firm spring too, which stands where it tells one. Of a drive all of
/// it again where what was found tells accelerations of other bandwidths (best_bandwidths), which
/// stands where it predicts recordings held out better. No name is taken away yet. Errors: those of
/// the fits.
Result<Finding> find_causes(Frame frame, const Limits& limits,
                            const std::function<void(double, std::string_view)>& progress);

/// Less the names that are improbable (take_improbable_names).
Result<Finding> with_probable_names(Finding finding, const Limits& limits);

}  // namespace flexspline::studies
