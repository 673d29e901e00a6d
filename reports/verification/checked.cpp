#include "flexspline/reports/verification_view.hpp"

namespace flexspline::reports {
namespace {

constexpr const char* kCommands =
    "# compute the folder again and compare\n"
    "flexspline verify DIR\n"
    "# compare with a folder from elsewhere\n"
    "flexspline verify DIR --against OTHER\n"
    "# draw this page again from verification.json alone\n"
    "flexspline report DIR/verification";

Table tolerances_table(const VerificationView& view) {
  Table table{
      "tolerances",
      "What numbers of each class are held to. Relative to the number, or to the largest of "
      "its list.",
      {{"class", "", 3},
       {"of what", "", 3},
       {"numeric, relative", "", 2},
       {"numeric, of its std", "", 2},
       {"statistical, relative", "", 2}},
      {}};
  for (const ShownTolerance& one : view.tolerances) {
    table.rows.push_back({one.quantity, one.says, one.relative, one.of_std, one.statistical});
  }
  return table;
}

Table artefacts_table(const VerificationView& view) {
  Table table{"artefacts",
              "Every artefact.",
              {{"artefact", "", 3},
               {"level", "", 3},
               {"numbers compared", "", 0},
               {"not the same bits", "", 0},
               {"largest over tolerance", "", 2}},
              {}};
  for (const ShownCheck& one : view.artefacts) {
    table.rows.push_back({one.artefact, one.level, one.numbers, one.unequal, one.over_tolerance});
  }
  return table;
}

std::optional<Section> draw(const VerificationView& view) {
  Section section{"checked-section", "How it was checked, and how to do it again", {}};
  section.add(Paragraph{"Folder: " + view.folder});
  section.add(Listing{kCommands});
  section.fold("Tolerances", tolerances_table(view));
  section.fold("Every artefact", artefacts_table(view));
  return section;
}

}  // namespace

VerificationSectionRow describe_checked() { return {20, draw}; }

}  // namespace flexspline::reports
