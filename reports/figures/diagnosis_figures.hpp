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

/// The same by coordinate: means over time, motion, rate, effort, and orders of the motor's turn.
Figure ordered_residuals_figure(const DiagnosisView& view);

/// The loop of a recording kept back, beside the model without and with what was left out.
Figure headline_figure(const DiagnosisView& view);

/// Series as they stand, the one with the largest mismatch first.
std::vector<const ShownSeries*> worst_first(const DiagnosisView& view);

/// What a picker over the series is called, and what it says for one of them.
std::vector<std::string> pickers_of(const DiagnosisView& view);
std::vector<std::string> choice_of(const DiagnosisView& view, const ShownSeries& series);

}  // namespace flexspline::reports
