#include "flexspline/reports/trial_view.hpp"

namespace flexspline::reports {
namespace {

constexpr const char* kCommands =
    "# conceal, diagnose, unseal and score again, with the same seeds\n"
    "flexspline trial STUDY.toml --out AGAIN\n"
    "# draw this page again from trial.json alone\n"
    "flexspline report DIR";

std::optional<Section> draw(const TrialView& view) {
  Section section{"provenance-section", "How it was done, and how to get it again", {}};
  section.add(Paragraph{
      "Every case hid effects on a virtual drive that shares no formula with what fits. A salted "
      "hash of the answer was published before the diagnosis began; the diagnosis saw the "
      "recordings alone; then the seal was opened and had to match."});
  for (const std::string& one : view.not_concealed) {
    section.add(Paragraph{"Not concealed, and not scored: " + one});
  }
  section.add(Listing{kCommands});
  section.fold("Design", Listing{view.design});
  if (!view.build_id.empty()) section.fold("Design", Paragraph{"Build " + view.build_id});
  return section;
}

}  // namespace

TrialSectionRow describe_trial_provenance() { return {40, draw}; }

}  // namespace flexspline::reports
