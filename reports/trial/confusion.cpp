#include "figures/trial_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

Table confusion_table(const TrialView& view) {
  Table table{"trial-confusion",
              "The same as a list.",
              {{"hidden", "", 3}, {"named first", "", 3}, {"cases", "", 0}},
              {}};
  for (const ShownConfusion& one : view.confusion) {
    table.rows.push_back({words(one.truth), words(one.named), one.count});
  }
  return table;
}

Table twins_table(const TrialView& view) {
  Table table{"trial-twins",
              "Structurally equivalent: two effects that leave the same signal whatever such a rig "
              "records. Either counts as the other.",
              {{"rig", "", 3}, {"effect", "", 3}, {"twin", "", 3}, {"because", "", 3}},
              {}};
  for (const ShownTwin& one : view.twins) {
    table.rows.push_back({one.rig, words(one.effect), words(one.twin), one.reason});
  }
  return table;
}

std::optional<Section> draw(const TrialView& view) {
  if (view.confusion.empty()) return std::nullopt;
  Section section{"confusion-section", "What was taken for what?", {}};
  section.add(confusion_figure(view));
  section.fold("As a table", confusion_table(view));
  if (!view.twins.empty())
    section.fold("Equivalent effects, not separable on such recordings", twins_table(view));
  return section;
}

}  // namespace

TrialSectionRow describe_confusion() { return {10, draw}; }

}  // namespace flexspline::reports
