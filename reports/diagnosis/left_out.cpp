#include <cmath>

#include "flexspline/reports/diagnosis_view.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

/// No finite data make anything certain.
std::string probability_of(const ShownCause& cause) {
  return cause.probability > 0.999 ? "above 99.9" : digits(100.0 * cause.probability, 3);
}

std::string sentence_of(const ShownCause& cause) {
  std::string text = "Left out";
  if (std::isfinite(cause.probability)) {
    text += " with probability " + probability_of(cause) + " %";
  }
  if (std::isfinite(cause.size_fraction)) {
    text += "; at its largest it is " + digits(100.0 * cause.size_fraction, 2) +
            " % of the largest torque";
  }
  text += ".";
  if (cause.alternatives.empty()) return text;
  text += " On these recordings the same signal could as well come from ";
  for (std::size_t i = 0; i < cause.alternatives.size(); ++i) {
    text += (i == 0 ? "" : " or ") + words(cause.alternatives[i]);
  }
  return text + ": the data do not decide between them.";
}

Table parameters_table(const ShownCause& cause) {
  Table table{"parameters-" + slug(cause.effect),
              "Parameters of " + words(cause.effect) +
                  " with their standard deviations and 95 % intervals.",
              {{"parameter", "", 3},
               {"value", "", 4},
               {"std", "", 2},
               {"from", "", 4},
               {"to (95 %)", "", 4},
               {"unit", "", 3}},
              {}};
  for (const Parameter& one : cause.parameters) {
    table.rows.push_back({one.name, one.value, one.std, one.lower, one.upper, one.unit});
  }
  return without_empty_columns(std::move(table));
}

Table evidence_table(const DiagnosisView& view) {
  Table table{
      "evidence",
      "What speaks for each cause. p: that noise alone would score as high. Delta BIC: with "
      "it less without it, negative speaks for it. Hold-out ratio: misfit with it over "
      "misfit without it, on recordings that the fit had not seen.",
      {{"left out", "", 3}, {"p", "", 2}, {"delta BIC", "", 3}, {"hold-out ratio", "", 3}},
      {}};
  for (const ShownCause& cause : view.causes) {
    table.rows.push_back(
        {words(cause.effect), cause.p_value, cause.delta_bic, cause.holdout_ratio});
  }
  return without_empty_columns(std::move(table));
}

std::string nothing_named(const DiagnosisView& view) {
  return view.adequate()
             ? "Nothing: the baseline is enough for these recordings."
             : "No effect of the catalogue is named. What is left over has a place (see "
               "above) but no physical name.";
}

std::optional<Section> draw(const DiagnosisView& view) {
  Section section{"left-out-section", "What was left out?", {}};
  if (view.causes.empty()) {
    section.add(Paragraph{nothing_named(view)});
    return section;
  }
  for (const ShownCause& cause : view.causes) {
    section.add(Heading{words(cause.effect)});
    section.add(Paragraph{sentence_of(cause)});
    if (!cause.equation.empty()) section.add(Listing{cause.equation});
    if (!cause.parameters.empty()) section.add(parameters_table(cause));
  }
  section.add(Heading{"Evidence"});
  section.add(evidence_table(view));
  return section;
}

}  // namespace

DiagnosisSectionRow describe_left_out() { return {20, draw}; }

}  // namespace flexspline::reports
