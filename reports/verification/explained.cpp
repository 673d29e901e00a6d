#include "figures/verification_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

Table changed_table(const VerificationView& view) {
  Table table{
      "changed",
      "What the two runs did not share. Only this can explain a difference beyond rounding; "
      "what is not listed is the same.",
      {{"kind", "", 3}, {"what", "", 3}, {"then", "", 3}, {"now", "", 3}},
      {}};
  for (const ShownCircumstance& one : view.changed) {
    table.rows.push_back({one.kind, one.name, one.before, one.after});
  }
  return table;
}

Table differences_table(const VerificationView& view) {
  Table table{"differences",
              "The largest differences of each artefact beyond rounding.",
              {{"artefact", "", 3},
               {"where", "", 3},
               {"class", "", 3},
               {"then", "", 3},
               {"now", "", 3},
               {"over tolerance", "", 2},
               {"level", "", 3}},
              {}};
  for (const ShownCheck& check : view.artefacts) {
    if (!check.reason.empty()) {
      table.rows.push_back({check.artefact, check.reason, "", "", "", kAbsent, check.level});
    }
    for (const ShownDifference& one : check.worst) {
      if (one.level == "numeric") continue;
      table.rows.push_back({check.artefact, one.where, one.quantity, one.before, one.after,
                            one.over_tolerance, one.level});
    }
  }
  return table;
}

std::optional<Section> draw(const VerificationView& view) {
  Section section{"explained-section", "What is different, and why?", {}};
  Figure figure = differences_figure(view);
  const Table differences = differences_table(view);
  if (figure.frames.empty() && differences.rows.empty()) {
    section.add(Verdict{"Nothing is."});
  } else if (view.changed.empty()) {
    section.add(Verdict{"Nothing that is recorded changed between the runs."});
  }
  if (!figure.frames.empty()) section.add(std::move(figure));
  if (!view.changed.empty()) section.add(changed_table(view));
  if (!differences.rows.empty()) section.add(without_empty_columns(differences));
  return section;
}

}  // namespace

VerificationSectionRow describe_explained() { return {10, draw}; }

}  // namespace flexspline::reports
