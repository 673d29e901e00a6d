#pragma once

#include <vector>

#include "diagnosis/model/model.hpp"

namespace flexspline::studies {

/// The sign with which dry friction across the transmission turns with phi', shares that add up to
/// one: of an angle that travels as the baseline's dry friction does, which is a mixture over
/// travelling_widths(), where it has none a hundredth of the largest rate; else rounded off below
/// the slowest rate, or a thousandth of the largest.
std::vector<SignPart> torsion_sign(const Frame& frame, const DriveModel& model);

}  // namespace flexspline::studies
