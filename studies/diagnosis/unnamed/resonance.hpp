#pragma once

#include <optional>
#include <string>

#include "diagnosis/proof/prove.hpp"

namespace flexspline::studies {

/// A resonance that the model lacks, in the residual r of an equation:
///     r = a (q - u) + b q'/w,   q'' + 2 z w q' + w^2 q = w^2 u,
/// u the torque that the model predicts, w and z the mode's frequency (rad/s) and damping ratio.
/// It is the test of a residual against past inputs (Ljung, System Identification, 1999, section
/// 16.5) for the one dynamics that noise models take for noise: a mode that rings.
struct Resonance {
  Equation equation = Equation::torsion;
  double frequency = 0.0;  ///< w, of the fit to all rows
  double damping = 0.0;    ///< z
  double size = 0.0;       ///< largest r over the largest torque of the equation
  HoldoutProof proof;      ///< by modes chosen and fitted without the rows that judge them
};

/// The resonance that takes most of what is left on recordings held out, over the largest torque of
/// its equation, where it is proved there (is_proved_part). Frequencies from 1/longest_lag of the
/// motion, below which a mode follows it, and one period in the longest recording, to five rows a
/// period; damping ratios from 1/(w T), T the longest recording, in which the mode decays, to
/// 1/sqrt(2), beyond which it has no peak. Rows are taken as evenly spaced within a recording.
std::optional<Resonance> find_resonance(const Frame& frame, const Findings& final,
                                        const Proof& proof, const Limits& limits);

std::string in_words(const Resonance& resonance);

}  // namespace flexspline::studies
