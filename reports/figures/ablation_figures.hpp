#pragma once

#include "ablation.hpp"
#include "figures/study_figures.hpp"

namespace flexspline::reports {

/// Ratio of errors before and after each step, an input a line, on a logarithmic axis.
Figure ablation_figure(const StudyView& view, const AblationPlan& plan);

/// The same over the noise of angle and torque, a frame a step; empty where no input has its own.
Figure ablation_noise_figure(const StudyView& view, const AblationPlan& plan);

}  // namespace flexspline::reports
