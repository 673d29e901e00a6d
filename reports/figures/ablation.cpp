#include <algorithm>
#include <cmath>
#include <set>

#include "figures/ablation_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

/// Inputs on which some step can be judged, in the study's order.
std::vector<const Input*> judged_inputs(const StudyView& view, const AblationPlan& plan) {
  std::set<const Input*> judged;
  for (const Contrast& contrast : plan.contrasts) {
    for (const Gain& gain : gains_of(view, contrast.from, contrast.to)) judged.insert(gain.input);
  }
  return {judged.begin(), judged.end()};
}

Panel step_panel(const StudyView& view, const std::string& title, double Gain::*of,
                 const AblationPlan& plan) {
  const auto inputs = judged_inputs(view, plan);
  Panel panel;
  panel.title = title;
  panel.x.label = "error before / error after";
  panel.x.log = true;
  panel.marks.push_back({1.0, "no change"});
  for (const Input* input : inputs) panel.y.categories.push_back(input->id);
  int rank = 0;
  for (const Contrast& contrast : plan.contrasts) {
    Series series{contrast.title, "points", {"plain", rank++}, {}, {}, {}, {}};
    for (const Gain& gain : gains_of(view, contrast.from, contrast.to)) {
      if (!(gain.*of > 0.0) || !std::isfinite(gain.*of)) continue;
      series.x.push_back(rounded(gain.*of, 4));
      series.y.push_back(
          static_cast<double>(std::ranges::find(inputs, gain.input) - inputs.begin()));
    }
    if (!series.x.empty()) panel.series.push_back(std::move(series));
  }
  return panel;
}

/// Gains over the noise of the angle, a line for each noise of the torque.
Panel noise_panel(const std::vector<Gain>& gains, const AblationPlan& plan,
                  const std::string& truth) {
  std::map<double, std::map<double, double>> lines;
  for (const Gain& gain : gains) {
    const auto noise = plan.noise.find(gain.input->id);
    if (gain.input->truth_id != truth || noise == plan.noise.end()) continue;
    if (!std::isfinite(gain.torque)) continue;
    lines[noise->second.torque][noise->second.angle] = gain.torque;
  }
  Panel panel;
  panel.title = words(truth);
  panel.x.label = "noise of the angle / % of amplitude";
  panel.x.log = true;
  panel.y.label = "error before / error after";
  int rank = 0;
  for (const auto& [torque, points] : lines) {
    Series series{
        compact(torque, 2) + " % torque noise", "line", {"plain", rank++}, {}, {}, {}, {}};
    for (const auto& [angle, gain] : points) {
      series.x.push_back(rounded(angle, 3));
      series.y.push_back(rounded(gain, 4));
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

}  // namespace

Figure ablation_figure(const StudyView& view, const AblationPlan& plan) {
  Figure figure;
  figure.id = "ablation-steps";
  figure.kind = "scatter";
  figure.title = "What each step does to the errors";
  figure.caption =
      "Error before the step over error after it: right of 1 the step helps, by decades. g⁻¹ over "
      "the training range; torque: median over the held-out recordings within it.";
  figure.alt = "Ratio of errors by every step of the ablation, for every input.";
  Frame frame;
  for (Panel& panel :
       std::vector<Panel>{step_panel(view, function_label("g_inverse"), &Gain::g_inverse, plan),
                          step_panel(view, "torque, held out", &Gain::torque, plan)}) {
    if (!panel.series.empty()) frame.panels.push_back(std::move(panel));
  }
  if (!frame.panels.empty()) figure.frames.push_back(std::move(frame));
  return figure;
}

Figure ablation_noise_figure(const StudyView& view, const AblationPlan& plan) {
  Figure figure;
  figure.id = "ablation-noise";
  figure.title = "Where each step pays, by the noise of angle and torque";
  figure.caption =
      "Median torque error on held-out recordings before the step over that after it; above 1 the "
      "step helps.";
  figure.alt = "Ratio of errors over the noise of the angle, for several noises of the torque.";
  figure.pickers = {"step"};
  for (const Contrast& contrast : plan.contrasts) {
    const auto gains = gains_of(view, contrast.from, contrast.to);
    std::set<std::string> truths;
    for (const Gain& gain : gains) {
      if (plan.noise.contains(gain.input->id)) truths.insert(gain.input->truth_id);
    }
    Frame frame{{contrast.title}, {}};
    for (const std::string& truth : truths) frame.panels.push_back(noise_panel(gains, plan, truth));
    if (!frame.panels.empty()) figure.frames.push_back(std::move(frame));
  }
  return figure;
}

}  // namespace flexspline::reports
