#pragma once

#include <utility>
#include <vector>

#include "bench/prescribed_motion.hpp"

namespace flexspline::data {

/// The torque of Maxwell slip elements at every sample of a motion, each seen late_s after it is
/// due; they start at rest and unloaded. Exact: an element's state is a clamp of its last state
/// plus the travel as long as the motion does not turn, and turning points between samples are
/// located.
std::vector<double> slip_torque(const std::vector<std::pair<double, double>>& elements,
                                const PrescribedMotion& motion, int samples, double late_s);

}  // namespace flexspline::data
