#pragma once

#include "flexspline/data/bench.hpp"

namespace flexspline::data {

/// Table I's loop without viscosity: its half height at 0.2 deg made by slip elements (to 0.44 %),
/// its midline by these and a rising f; g^-1 = 0, h = 1. The share scales the elements after the
/// fit. The midline is met to 2.4 % of the peak: around zero the elements alone are stiffer than
/// Table I's f, so the fitted f is flat there.
BenchTruth slip_truth(double share);

}  // namespace flexspline::data
