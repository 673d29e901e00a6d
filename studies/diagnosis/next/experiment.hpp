#pragma once

#include <vector>

#include "diagnosis/search/selection.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {

/// Of every cause that has an alternative, and of the first one beside what came next behind it:
/// the motion (next_motions) along which both models, as fitted, differ most in the torques of all
/// equations, in standard deviations of the noise. Below 5 it says that none separates them.
std::vector<NextExperiment> next_experiments(const Frame& frame, const Selection& selection);

/// Whether all recordings run the torsion at one amplitude and one rate, so that g^-1 can take up a
/// memory that knows no rate.
bool one_loop(const Frame& frame);

/// What settles one loop: the same amplitude at a quarter of its rate.
NextExperiment another_rate(const Frame& frame);

}  // namespace flexspline::studies
