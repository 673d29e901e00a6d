#pragma once

#include "flexspline/reports/figure.hpp"
#include "flexspline/reports/verification_view.hpp"

namespace flexspline::reports {

/// How many artefacts agree at which level, by their kind.
Figure agreement_figure(const VerificationView& view);

/// Largest difference of each artefact over its tolerance; without frames where every bit agrees.
Figure differences_figure(const VerificationView& view);

}  // namespace flexspline::reports
