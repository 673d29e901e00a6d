#pragma once

#include <string>
#include <vector>

#include "diagnosis/search/search.hpp"

namespace flexspline::studies {

/// How much of an equation's residual a coordinate orders.
struct CoordinateScore {
  Equation equation = Equation::torsion;
  std::string coordinate;
  double statistic = 0.0;  ///< n ln(SS0/SS1) less the Bayesian penalty, n over the noise's colour
  double share = 0.0;      ///< of the weighted sum of squares that it takes away
  double size = 0.0;       ///< largest that it takes away over the equation's largest torque
  std::string says;
};

/// The residuals of the findings over every coordinate of diagnosis.md, the strongest first. Each
/// coordinate is a few columns (bins of torsion, speed, load and angle, turns of the motor at
/// every order, the time since the last reversal, the rate of the prediction, ...), regressed on
/// the residual as it is.
std::vector<CoordinateScore> locate(const Frame& frame, const Findings& findings);

/// The same, and what two order that neither orders alone: position and speed (5 x 5 bins), torque
/// and recording (a gain of each: a stiffness that warms up, say). For a verdict that nothing was
/// left out; causes are not chosen by it, as the forms of large ones leave as much.
std::vector<CoordinateScore> locate_anything(const Frame& frame, const Findings& findings);

/// The window of a recording where an equation's smoothed residual is largest.
struct WorstWindow {
  std::size_t segment = 0;
  double from_s = 0.0;
  double to_s = 0.0;
};
WorstWindow worst_window(const Frame& frame, const Findings& findings, Equation equation);

}  // namespace flexspline::studies
