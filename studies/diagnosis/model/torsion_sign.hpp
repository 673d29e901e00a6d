#pragma once

#include <vector>

#include "diagnosis/model/model.hpp"

namespace flexspline::studies {

/// The sign with which dry friction across the transmission turns with phi',
///   s = sum_k c_k tanh(phi'/w_k), c_k > 0, sum c_k = 1, w_k in rad/s (m/s).
/// Of an angle that travels the w_k are dry_widths() and the c_k those of the baseline's dry
/// friction, as fitted to this frame, the motion as the model's causes see it; where it has none,
/// one hundredth of the largest rate. Else one width: the slowest rate, or a thousandth of the
/// largest. Not modelled: another sign of what a cause adds than of the baseline's own friction.
std::vector<SignPart> torsion_sign(const Frame& frame, const DriveModel& model);

}  // namespace flexspline::studies
