#pragma once

#include "decision/evidence.hpp"
#include "diagnosis/frame.hpp"

namespace flexspline::studies::decision {

/// What a baseline and named causes may leave: low-rank functions of one coordinate or two, all
/// rows of the frame, each centred. A column set scales to one percent of the equation's largest
/// torque at unit variance.
struct Discrepancy {
  Eigen::MatrixXd columns;
  std::vector<Component> components;
};

/// Splines of rate, acceleration, way since the last reversal, load with the sign of motion, time
/// of the session (with the rate), lagging motion, motor and load angle, torsion by rate, side of
/// each recording, and windows of a recording no shorter than one of its cycles.
Discrepancy discrepancy_of(const Frame& frame, Equation equation);

/// Of each recording the rows between one reversal and the next but one, median over the set.
double rows_per_cycle(const Frame& frame, Equation equation);

/// Puts a block of columns beside those that are there.
void add_block(Discrepancy& to, Eigen::MatrixXd columns, std::string coordinate, std::string says,
               double unit, const Eigen::ArrayXd& usable);

}  // namespace flexspline::studies::decision
