#pragma once

#include <string>
#include <vector>

#include "flexspline/reports/artefacts.hpp"
#include "flexspline/reports/figure.hpp"

namespace flexspline::reports {

/// What is left of one model along a recording.
struct Remainder {
  std::string name;
  Role role;
  std::vector<double> values;
};

/// What a recording says at each sample; what is empty has no panel.
struct Coordinates {
  std::vector<double> time, motion, rate, effort;
  std::vector<double> phase;  ///< rad; a turn is what orders are counted by
  std::string turn;           ///< "of the motor", "of the excitation"
  ShownUnits units;
};

/// One panel a coordinate: means of the remainder over stretches of it, with twice their standard
/// error where `bands`; and the amplitude at each order of the phase.
std::vector<Panel> residual_panels(const Coordinates& at, const std::vector<Remainder>& left,
                                   bool bands);

}  // namespace flexspline::reports
