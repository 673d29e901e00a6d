#pragma once

#include <vector>

namespace flexspline::studies {

/// Median of those that are numbers, the mean of the two in the middle; NaN where there is none.
double middle_of(std::vector<double> values);

}  // namespace flexspline::studies
