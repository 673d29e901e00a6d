#pragma once

#include <string>

#include "flexspline/reports/figure.hpp"
#include "flexspline/reports/study_view.hpp"

namespace flexspline::reports {

/// Effort over motion on the operating point's recording: measured and every estimator; one frame
/// an input.
Figure own_loop_figure(const StudyView& view);

/// The same for every recording, picked by amplitude and frequency (by name, off the grid). Thinned
/// so that the page stays light.
Figure loops_figure(const StudyView& view);

/// Error in percent of peak over amplitude x frequency, a panel an estimator, a frame an input; off
/// the grid over recording x estimator.
Figure error_map_figure(const StudyView& view);

/// f, g^-1 and h with their 95 % bands, truth, and the end of each domain of validity.
Figure function_figure(const StudyView& view);

/// Errors of f, g^-1 and torque elsewhere, an input a line, on a logarithmic axis.
Figure error_overview_figure(const StudyView& view);

/// Half height of the measured loop against amplitude and against frequency.
Figure half_height_figure(const StudyView& view);

/// Table I's polynomials up to 1.5 times the range on which they were fitted.
Figure table_one_figure(const Paper& paper);

/// A figure of the paper: as printed, and ours beside it, with the full trajectory where there is
/// one for Table I.
Figure paper_figure(const StudyView& view, const PaperFigure& figure);

/// Errors of each estimator over the whole study: median and worst, trained and held out.
Figure estimators_figure(const StudyView& view);

/// What each estimator leaves on each recording, in order of time, motion, rate, effort and
/// harmonics of the motion.
Figure ordered_residuals_figure(const StudyView& view);

/// How many evaluations each fit took.
Figure convergence_figure(const StudyView& view);

/// Names of functions for people: g_inverse is g⁻¹.
std::string function_label(const std::string& function);

Role role_of(const EstimatorView& estimator);

}  // namespace flexspline::reports
