#pragma once

#include <vector>

#include "diagnosis/proof/prove.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {

/// Recordings as measured and as predicted by two models, decimated.
std::vector<DiagnosedSeries> series_of(const Frame& frame, Equation equation,
                                       const Eigen::ArrayXd& before, const Eigen::ArrayXd& after);

/// Recordings as measured and as predicted, those held out by fits that did not see them.
std::vector<DiagnosedSeries> proved_series(const Frame& frame, const Selection& selection,
                                           const Proof& proof);

}  // namespace flexspline::studies
