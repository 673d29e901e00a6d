#include "flexspline/reports/section.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

/// What the study's kind was asked, and what its cases answer.
std::optional<Section> draw(const StudyView& view) {
  const auto& kind = view.artefacts().kind;
  if (!kind) return std::nullopt;
  Section section{"kind", kind->question, {}};
  section.add(Verdict{kind->says});
  for (const std::string& note : kind->notes) section.add(Paragraph{note});
  if (kind->failed > 0.0 || kind->done < kind->cases) {
    section.add(Paragraph{"Of " + compact(kind->cases, 9) + " cases " + compact(kind->done, 9) +
                          " are there, and " + compact(kind->failed, 9) +
                          " of those failed; numbers are of the others."});
  }
  for (const Figure& figure : kind->figures) section.add(figure);
  for (const Table& table : kind->tables) section.add(table);
  return section;
}

}  // namespace

SectionRow describe_kind() { return {-5, draw}; }

}  // namespace flexspline::reports
