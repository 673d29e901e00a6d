#include <algorithm>
#include <cmath>

#include "figures/ablation_figures.hpp"
#include "flexspline/reports/section.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

Table steps_table(const StudyView& view, const AblationPlan& plan) {
  Table table{"ablation",
              "Error before a step over error after it; above 1 the step helps. g⁻¹ over the "
              "training range; torque: median over the held-out recordings within it. Smallest, "
              "median and largest over the inputs.",
              {{"step", "", 3},
               {"from", "", 3},
               {"to", "", 3},
               {"inputs", "", 0},
               {"g⁻¹, least", "", 2},
               {"g⁻¹, median", "", 2},
               {"g⁻¹, most", "", 2},
               {"torque, least", "", 2},
               {"torque, median", "", 2},
               {"torque, most", "", 2}},
              {}};
  for (const Contrast& contrast : plan.contrasts) {
    const auto gains = gains_of(view, contrast.from, contrast.to);
    const Spread3 g = spread_of(gains, &Gain::g_inverse);
    const Spread3 torque = spread_of(gains, &Gain::torque);
    table.rows.push_back({contrast.title, contrast.from, contrast.to,
                          static_cast<double>(gains.size()), g.least, g.median, g.most,
                          torque.least, torque.median, torque.most});
  }
  return table;
}

/// The step that helps the held-out torque most in the median.
std::string verdict_of(const StudyView& view, const AblationPlan& plan) {
  const Contrast* best = nullptr;
  double most = kAbsent;
  for (const Contrast& contrast : plan.contrasts) {
    const double gain = spread_of(gains_of(view, contrast.from, contrast.to), &Gain::torque).median;
    if (!std::isfinite(gain) || most >= gain) continue;
    most = gain;
    best = &contrast;
  }
  if (best == nullptr) return "No step has held-out recordings to be judged on.";
  return "The largest step is " + best->title + ": median torque errors on held-out recordings " +
         digits(most, 2) + " times smaller.";
}

/// The noise at which a step pays most.
std::string pays_most(const StudyView& view, const AblationPlan& plan, const Contrast& contrast) {
  Gain best;
  for (const Gain& gain : gains_of(view, contrast.from, contrast.to)) {
    if (!plan.noise.contains(gain.input->id) || !std::isfinite(gain.torque)) continue;
    if (!(best.torque >= gain.torque)) best = gain;
  }
  if (best.input == nullptr) return {};
  const NoiseLevel noise = plan.noise.at(best.input->id);
  const std::string where = words(best.input->truth_id) + " with " + compact(noise.angle, 2) +
                            " % of noise in the angle and " + compact(noise.torque, 2) +
                            " % in the torque";
  if (best.torque <= 1.0) return contrast.title + " pays nowhere; it costs least on " + where + ".";
  return contrast.title + " pays most on " + where + ": errors " + digits(best.torque, 2) +
         " times smaller.";
}

std::optional<Section> draw(const StudyView& view) {
  const AblationPlan plan = parse_ablation(view.artefacts().lock);
  if (plan.contrasts.empty()) return std::nullopt;
  Section section{"ablation-section", "What does each step add?", {}};
  section.add(Verdict{verdict_of(view, plan)});
  if (!plan.noise.empty()) {
    for (const Contrast& contrast : plan.contrasts) {
      section.add(Paragraph{sentence(pays_most(view, plan, contrast))});
    }
  }
  if (Figure figure = ablation_noise_figure(view, plan); !figure.frames.empty()) {
    section.add(std::move(figure));
  } else if (Figure steps = ablation_figure(view, plan); !steps.frames.empty()) {
    section.add(std::move(steps));
  }
  section.add(steps_table(view, plan));
  return section;
}

}  // namespace

SectionRow describe_ablation() { return {35, draw}; }

}  // namespace flexspline::reports
