#pragma once

#include "decision/proof.hpp"

namespace flexspline::studies::decision {

/// The verdict by what is named, what is left and the held-out error over the noise.
Verdict verdict_of(const Decision& decision, const Proof& proof, const Calibration& calibration);

/// A decision and its proof in the words of flexspline-diagnosis/1.
void account(const Frame& frame, const Decision& decision, const Proof& proof,
             const Calibration& calibration, Diagnosis& to);

}  // namespace flexspline::studies::decision
