#pragma once

#include <vector>

#include "diagnosis/search/search.hpp"

namespace flexspline::studies {

/// Of the whole orders of a turn of the motor from one to another, those whose waves are strongest
/// in what a model leaves of an equation, |sum_r w_r^2 e_r exp(i k theta_r)|, w the weights of its
/// rows and e the residual; the strongest first, no more than asked for. What the baseline takes of
/// a wave is not accounted for: a wave that many times fits into a motion it has no part of.
std::vector<double> strong_orders(const Frame& frame, const Findings& findings, Equation equation,
                                  int from, int to, std::size_t most);

}  // namespace flexspline::studies
