#include <cmath>

#include "figures/diagnosis_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

std::string meaning_of(const std::string& verdict) {
  if (verdict == "adequate") {
    return "Adequate: the baseline explains the recordings to within their noise. Nothing is "
           "missing from it that they could show.";
  }
  if (verdict == "explained") {
    return "Explained: physics is missing from the baseline, and with it the recordings are "
           "explained to within "
           "their noise.";
  }
  if (verdict == "partly_explained") {
    return "Partly explained: missing physics was found, but an unexplained residual remains that "
           "no effect of "
           "the catalogue explains.";
  }
  if (verdict == "unexplained") {
    return "Unexplained: physics is missing from the baseline to which no effect of the catalogue "
           "can give a "
           "name.";
  }
  if (verdict == "undecided") {
    return "Undecided: these recordings do not show whether physics is missing, or which.";
  }
  return "The verdict is not one of flexspline-diagnosis/1: " + verdict;
}

std::string with_unit(const DiagnosisView& view, double rmse) {
  return digits(rmse, 3) + " " + view.rmse_unit;
}

std::string baseline_sentence(const DiagnosisView& view) {
  if (!std::isfinite(view.rmse_train)) return "Nothing was fitted.";
  std::string text = "The baseline (" + view.baseline + ") leaves " +
                     with_unit(view, view.rmse_train) + " rms on the recordings it was fitted to";
  if (std::isfinite(view.rmse_holdout)) {
    text += " and " + with_unit(view, view.rmse_holdout) + " on rows held out from it";
  }
  return text + "; the noise is " + with_unit(view, view.noise) + ".";
}

Table causes_table(const DiagnosisView& view) {
  Table table{
      "causes",
      "Missing physics, largest first. The size is the largest contribution, with its 95 % "
      "interval, and in percent of the largest torque; the probability is that the name is right, "
      "calibrated on simulated cases and on effects added to recordings by others; the hold-out "
      "ratio is the misfit with it, beside all the others, over the misfit without it, "
      "cross-validated, selection not nested.",
      {{"missing", "", 3},
       {"size", "", 3},
       {"from", "", 3},
       {"to", "", 3},
       {"unit", "", 3},
       {"of the largest torque", "%", 2},
       {"probability", "", 2},
       {"hold-out ratio", "", 2},
       {"could as well be", "", 3}},
      {}};
  for (const ShownCause& cause : view.causes) {
    std::string others;
    for (const std::string& one : cause.alternatives) {
      others += (others.empty() ? "" : ", ") + words(one);
    }
    table.rows.push_back({words(cause.effect), cause.size, cause.size_lower, cause.size_upper,
                          cause.unit, 100.0 * cause.size_fraction, cause.probability,
                          cause.holdout_ratio, others.empty() ? "–" : others});
  }
  return without_empty_columns(std::move(table));
}

std::optional<Section> draw(const DiagnosisView& view) {
  Section section{"verdict", "In short", {}};
  const std::string meaning = meaning_of(view.verdict);
  section.add(Verdict{view.says.empty() ? meaning : sentence(view.says)});
  if (!view.says.empty() && !view.adequate()) section.add(Paragraph{meaning});
  section.add(Paragraph{baseline_sentence(view)});
  if (Figure figure = headline_figure(view); !figure.frames.empty()) {
    section.add(std::move(figure));
  }
  if (!view.causes.empty()) section.add(causes_table(view));
  return section;
}

}  // namespace

DiagnosisSectionRow describe_diagnosis_verdict() { return {0, draw}; }

}  // namespace flexspline::reports
