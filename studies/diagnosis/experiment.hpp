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

}  // namespace flexspline::studies
