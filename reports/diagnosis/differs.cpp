#include <cmath>

#include "figures/diagnosis_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

std::string interval_of(const ShownMismatch& one) {
  if (!std::isfinite(one.from_s) || !std::isfinite(one.to_s)) return "throughout";
  return compact(one.from_s, 4) + " to " + compact(one.to_s, 4) + " s";
}

std::string depends_on(const ShownMismatch& one) {
  if (one.coordinate == "reversal_memory") return "distance since the last reversal";
  return words(one.coordinate);
}

std::string sentence_of(const DiagnosisView& view) {
  if (view.mismatch.empty()) {
    return view.adequate() ? "Nowhere beyond the noise."
                           : "No place stands out: the artefact names no mismatch.";
  }
  const ShownMismatch& worst = view.mismatch.front();
  std::string text = "Largest mismatch: ";
  if (!worst.equation.empty()) text += worst.equation + " equation, ";
  text += "depends on the " + depends_on(worst) + "; largest in " + worst.recording + ", " +
          interval_of(worst);
  if (!worst.says.empty()) text += ". What is seen: " + worst.says;
  return sentence(text);
}

Table mismatch_table(const DiagnosisView& view) {
  Table table{
      "mismatch",
      "Where the baseline and the recordings differ. The share is that of the misfit beyond "
      "noise that this coordinate explains.",
      {{"depends on", "", 3},
       {"share", "%", 2},
       {"equation", "", 3},
       {"recording", "", 3},
       {"where", "", 3},
       {"what is seen", "", 3}},
      {}};
  for (const ShownMismatch& one : view.mismatch) {
    table.rows.push_back({depends_on(one), 100.0 * one.share_of_excess, one.equation, one.recording,
                          interval_of(one), one.says});
  }
  return table;
}

std::optional<Section> draw(const DiagnosisView& view) {
  Section section{"differs-section", "Where do model and recordings differ?", {}};
  section.add(Verdict{sentence_of(view)});
  if (Figure figure = mismatch_figure(view); !figure.frames.empty()) {
    section.add(std::move(figure));
    section.add(remainder_figure(view));
  }
  if (Figure figure = over_velocity_figure(view); !figure.frames.empty()) {
    section.add(std::move(figure));
  }
  if (!view.mismatch.empty()) section.add(mismatch_table(view));
  if (Figure figure = ordered_residuals_figure(view); !figure.frames.empty()) {
    section.fold("By time, torsion, velocity, load and order", std::move(figure));
  }
  return section;
}

}  // namespace

DiagnosisSectionRow describe_differs() { return {10, draw}; }

}  // namespace flexspline::reports
