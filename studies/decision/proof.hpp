#pragma once

#include "decision/decide.hpp"

namespace flexspline::studies::decision {

/// Errors on recordings that had no part in choosing anything. SI, at the output.
struct Proof {
  HoldoutProof holdout;
  Equation equation = Equation::torsion;
  std::vector<double> before, after;  ///< predicted torque by row of the frame; NaN: not held out
  std::vector<std::vector<std::string>> named;  ///< by fold
  std::vector<double> cause_ratio;  ///< error with each named cause over the error without it
};

/// The whole decision anew in every outer fold, on recordings from which the held-out rows are
/// deleted; its model, fitted without a remainder, is judged on these rows.
/// Errors: what makes a fold's recordings unusable.
Result<Proof> prove(const RecordingSet& set, const Frame& frame, const Decision& decision,
                    const Calibration& calibration, unsigned threads);

}  // namespace flexspline::studies::decision
