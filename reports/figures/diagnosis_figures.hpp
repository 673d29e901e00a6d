#pragma once

#include "flexspline/reports/diagnosis_view.hpp"
#include "flexspline/reports/figure.hpp"

namespace flexspline::reports {

/// Loop and time axis of every recording: measured, and modelled without and with what was left
/// out; the intervals of the mismatches highlighted, the recording of the first one first.
Figure mismatch_figure(const DiagnosisView& view);

/// Measured less modelled, of the frames of mismatch_figure.
Figure remainder_figure(const DiagnosisView& view);

/// The remainder over the velocity, where that is what orders it; without frames otherwise.
Figure over_velocity_figure(const DiagnosisView& view);

/// How much of the misfit each candidate would explain, by round of the search.
Figure candidates_figure(const DiagnosisView& view);

/// Misfit of every recording before and after, beside the noise floor.
Figure before_after_figure(const DiagnosisView& view);

}  // namespace flexspline::reports
