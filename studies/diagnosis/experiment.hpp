#pragma once

#include <optional>

#include "diagnosis/selection.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {

/// The sine that tells the best cause from its closest rival by the most sigma: both models, as
/// fitted, are run over amplitudes up to the largest recorded and frequencies from a tenth of the
/// slowest to thrice the fastest, on the torsion law. Absent where there is no rival, and on the
/// free rig, whose torsion follows from the load.
std::optional<NextExperiment> next_experiment(const Frame& frame, const Selection& selection);

/// Whether all recordings run the torsion at one amplitude and one rate, so that g^-1 can take up a
/// memory that knows no rate.
bool one_loop(const Frame& frame);

/// What settles one loop: the same amplitude at a quarter of its rate.
NextExperiment another_rate(const Frame& frame);

}  // namespace flexspline::studies
