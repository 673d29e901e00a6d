#pragma once

#include <vector>

namespace flexspline::data {

/// First and second derivative on an even grid, by central differences; at rest before the start.
std::vector<double> slopes(const std::vector<double>& values, double step);
std::vector<double> bends(const std::vector<double>& values, double step);

/// The value at a place counted in steps, by the cubic through four neighbours; held at the ends.
double between(const std::vector<double>& values, double place);

/// The signal as it was late steps ago.
std::vector<double> delayed(const std::vector<double>& values, double late);

}  // namespace flexspline::data
