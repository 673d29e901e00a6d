#pragma once

#include "flexspline/reports/figure.hpp"
#include "flexspline/reports/trial_view.hpp"

namespace flexspline::reports {

/// A rate of docs/trials.md in words.
std::string rate_title(const std::string& name);

/// The rates that a trial is about, in the order in which they are told; those without cases are
/// left out.
std::vector<std::pair<std::string, ShownRate>> told_rates(const ShownScores& scores);

/// The rates with their intervals.
Figure rates_figure(const TrialView& view);

/// Share of right names over their printed probability.
Figure reliability_figure(const TrialView& view);

/// What was hidden against what was named first, in counts.
Figure confusion_figure(const TrialView& view);

/// Share detected, named first and exactly over the size of a single effect.
Figure detection_figure(const TrialView& view);

}  // namespace flexspline::reports
