#include "flexspline/reports/section.hpp"

namespace flexspline::reports {
namespace {

/// What a page without these artefacts is worth, before anything else is said.
std::optional<Section> draw(const StudyView& view) {
  const Artefacts& artefacts = view.artefacts();
  if (artefacts.unreadable.empty()) return std::nullopt;
  Section section{"incomplete", "Not complete", {}};
  section.add(Verdict{std::to_string(artefacts.unreadable.size()) +
                      " of this study's artefacts cannot be read. Every number on this page is "
                      "computed without them, from " +
                      std::to_string(artefacts.cases.size()) + " cases."});
  for (const std::string& one : artefacts.unreadable) section.add(Paragraph{"Not read: " + one});
  return section;
}

}  // namespace

SectionRow describe_incomplete() { return {-10, draw}; }

}  // namespace flexspline::reports
