#include <cmath>

#include "figures/diagnosis_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

std::string meaning_of(const std::string& verdict) {
  if (verdict == "adequate") {
    return "Adequate: the baseline explains the recordings to within their noise. Nothing was left "
           "out that they could show.";
  }
  if (verdict == "explained") {
    return "Explained: something was left out, and with it the recordings are explained to within "
           "their noise.";
  }
  if (verdict == "partly_explained") {
    return "Partly explained: something was left out and found, but more is left that no effect of "
           "the catalogue explains.";
  }
  if (verdict == "unexplained") {
    return "Unexplained: something was left out to which no effect of the catalogue can give a name.";
  }
  return "The verdict is not one of flexspline-diagnosis/1: " + verdict;
}

std::string with_unit(const DiagnosisView& view, double rmse) {
  return digits(rmse, 3) + " " + view.rmse_unit;
}

std::string baseline_sentence(const DiagnosisView& view) {
  std::string text = "The baseline (" + view.baseline + ") leaves " +
                     with_unit(view, view.rmse_train) + " rms on the recordings it was fitted to";
  if (std::isfinite(view.rmse_holdout)) {
    text += " and " + with_unit(view, view.rmse_holdout) + " on those it had not seen";
  }
  return text + "; the noise is " + with_unit(view, view.noise) + ".";
}

Table causes_table(const DiagnosisView& view) {
  Table table{"causes",
              "What was left out, in the order in which the search took it in. The size is the "
              "largest contribution over the largest torque; the hold-out ratio is the misfit with "
              "it, beside all the others, over the misfit without it, on recordings that it had not "
              "seen.",
              {{"left out", "", 3},
               {"size", "%", 2},
               {"probability", "%", 3},
               {"hold-out ratio", "", 2},
               {"could as well be", "", 3}},
              {}};
  for (const ShownCause& cause : view.causes) {
    std::string others;
    for (const std::string& one : cause.alternatives) {
      others += (others.empty() ? "" : ", ") + words(one);
    }
    table.rows.push_back({words(cause.effect), 100.0 * cause.size_fraction,
                          100.0 * cause.probability, cause.holdout_ratio,
                          others.empty() ? "–" : others});
  }
  return table;
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
