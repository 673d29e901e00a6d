#pragma once

#include <string>

#include "diagnosis/frame/frame.hpp"

namespace flexspline::studies {

/// 1 for rows in which the motor slides, so that dry friction is a function of its motion; 0 where
/// it may stick and takes any torque up to its breakaway: slower than a fiftieth of its largest
/// speed (rad/s, of all recordings), or within 1/motor_bandwidth (s) of a reversal, as long as the
/// smoothed speed takes to turn. Not modelled: what a motor takes there, whose law has a state
/// (Armstrong-Helouvry, Dupont and Canudas de Wit 1994).
Eigen::ArrayXd motor_slides(const Frame& frame);

/// Which rows the motor equation is not judged on.
std::string sticking_in_words(const Frame& frame);

}  // namespace flexspline::studies
