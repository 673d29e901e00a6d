#pragma once

#include <string>
#include <vector>

#include "diagnosis/model/model.hpp"

namespace flexspline::studies {

/// Two causes of a model whose contributions to an equation nearly cancel.
struct Cancelling {
  std::size_t first = 0;
  std::size_t second = 0;
  Equation equation = Equation::motor;
  double left = 0.0;  ///< rms of their sum over the smaller one's

  bool has(std::size_t cause) const { return cause == first || cause == second; }
};

/// Pairs of causes whose sum in an equation is less than a share of the smaller one: rms over the
/// usable rows of x_i + x_k over the lesser of those of x_i and x_k, 0 to 2. Of these the
/// recordings tell the sum and neither of the two, as far as no other equation does
/// (docs/decisions/0035).
std::vector<Cancelling> cancelling(const Frame& frame, const DriveModel& model,
                                   const Reference& reference, double most_left);

std::string in_words(const DriveModel& model, const Cancelling& pair);

}  // namespace flexspline::studies
