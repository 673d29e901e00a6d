#include <cmath>

#include "flexspline/reports/diagnosis_view.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

constexpr double kSmallestP = 1e-12;  // beyond it nobody knows a noise's tails

std::string sentence_of(const ShownCause& cause) {
  std::string text = "Missing";
  if (std::isfinite(cause.probability)) {
    text += ", with a probability of " + digits(cause.probability, 2);
  }
  if (std::isfinite(cause.size_fraction)) {
    text += "; at its largest it is ";
    if (std::isfinite(cause.size)) text += digits(cause.size, 3) + " " + cause.unit + ", ";
    text += digits(100.0 * cause.size_fraction, 2) + " % of " +
            (cause.size_of.empty() ? "the largest torque" : cause.size_of);
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
                  " with their standard deviations and 95 % intervals: all parameters free, "
                  "noise and what differs between recordings counted, the form taken for right.",
              {{"parameter", "", 3},
               {"meaning", "", 3},
               {"value", "", 4},
               {"std", "", 2},
               {"from", "", 4},
               {"to (95 %)", "", 4},
               {"unit", "", 3},
               {"no interval", "", 3}},
              {}};
  for (const ShownCauseParameter& one : cause.parameters) {
    table.rows.push_back({one.name, one.meaning, one.value, one.std, one.lower, one.upper, one.unit,
                          one.no_interval});
  }
  return without_empty_columns(std::move(table));
}

Table evidence_table(const DiagnosisView& view) {
  Table table{
      "evidence",
      "What speaks for each cause. p: that noise alone would score as high. Delta BIC: with "
      "it less without it, negative speaks for it. Hold-out ratio: misfit with it over "
      "misfit without it, cross-validated, selection not nested. Named in: share of the outer "
      "folds, each searched anew without its recordings, that name it or an alternative.",
      {{"missing", "", 3},
       {"p", "", 2},
       {"delta BIC", "", 3},
       {"hold-out ratio", "", 3},
       {"named in", "%", 2}},
      {}};
  for (const ShownCause& cause : view.causes) {
    const bool tiny = cause.p_value <= kSmallestP;
    table.rows.push_back({words(cause.effect), tiny ? Cell("< 1e-12") : Cell(cause.p_value),
                          cause.delta_bic, cause.holdout_ratio, 100.0 * cause.stability});
  }
  return without_empty_columns(std::move(table));
}

std::string nothing_named(const DiagnosisView& view) {
  if (view.verdict == "undecided")
    return "Nothing is named: the effects are not identifiable from these recordings.";
  if (view.adequate()) return "Nothing: the baseline is enough for these recordings.";
  return view.has_additions()
             ? "No name is more likely right than wrong. The model has a part without a name, in "
               "the form of the effects that the verdict lists."
             : "No effect of the catalogue is named. The unexplained residual has a place (see "
               "above) but no physical name.";
}

std::optional<Section> draw(const DiagnosisView& view) {
  Section section{"left-out-section", "What physics is missing?", {}};
  if (view.causes.empty()) {
    section.add(Paragraph{nothing_named(view)});
    return section;
  }
  for (const ShownCause& cause : view.causes) {
    section.add(Heading{words(cause.effect)});
    section.add(Paragraph{sentence_of(cause)});
    if (!cause.equation.empty()) section.add(Equation{cause.equation});
    if (!cause.parameters.empty()) section.add(parameters_table(cause));
  }
  section.add(Heading{"Evidence"});
  section.add(evidence_table(view));
  return section;
}

}  // namespace

DiagnosisSectionRow describe_left_out() { return {20, draw}; }

}  // namespace flexspline::reports
