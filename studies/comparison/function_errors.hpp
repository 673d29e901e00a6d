#pragma once

#include <map>
#include <string>

#include "flexspline/core/estimate.hpp"
#include "inputs/prepared_input.hpp"

namespace flexspline::studies {

/// Errors of f and g^-1 (rms over the training range, both signs, in percent of the truth's value
/// at its edge) and of h (largest |ln h - ln h_true|, times 100). NaN where the truth has no such
/// function (slip elements, data sets) or, for h, where the estimate does not print one.
std::map<std::string, double> function_errors(const Estimate& estimate, const PreparedInput& input,
                                              const std::vector<std::string>& trained);

/// Largest amplitude and speed of the loops, rad and rad/s. Recordings without both do not count.
struct Reach {
  double motion = 0.0;
  double speed = 0.0;
};
Reach reach_of(const PreparedInput& input, const std::vector<std::string>& ids);

}  // namespace flexspline::studies
