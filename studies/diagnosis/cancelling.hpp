#pragma once

#include <string>
#include <vector>

#include "diagnosis/selection.hpp"

namespace flexspline::studies {

/// Two causes of a model whose contributions to an equation nearly cancel.
struct Cancelling {
  std::size_t first = 0;
  std::size_t second = 0;
  Equation equation = Equation::motor;
  double left = 0.0;  ///< rms of their sum over the smaller one's

  bool has(std::size_t cause) const { return cause == first || cause == second; }
};

/// Pairs whose sum is less than half of the smaller one (limits.half, rms over the usable rows):
/// the larger part of either is taken back by the other, and the recordings tell their sum and
/// neither of the two.
std::vector<Cancelling> cancelling(const Frame& frame, const DriveModel& model,
                                   const Reference& reference, const Limits& limits);

std::string in_words(const DriveModel& model, const Cancelling& pair);

}  // namespace flexspline::studies
