#include <array>

#include "figures/verification_figures.hpp"

namespace flexspline::reports {
namespace {

Table levels_table(const VerificationView& view) {
  struct Level {
    const char* name;
    const char* says;
  };
  constexpr std::array<Level, 5> levels = {{
      {"bitwise", "the same artefact to the last bit, wall-clock times aside"},
      {"numeric", "every number within the tolerance of its class"},
      {"statistical",
       "as two measurements of one thing agree; granted only where something is known to have "
       "changed"},
      {"differs", "beyond that"},
      {"missing", "only one of the runs has it"},
  }};
  Table table{"levels",
              "Artefacts by level of agreement.",
              {{"level", "", 3}, {"artefacts", "", 0}, {"meaning", "", 3}},
              {}};
  for (const Level& level : levels) {
    double count = 0.0;
    for (const ShownCheck& one : view.artefacts) count += one.level == level.name ? 1.0 : 0.0;
    table.rows.push_back({level.name, count, level.says});
  }
  return table;
}

std::optional<Section> draw(const VerificationView& view) {
  Section section{"verdict", "In short", {}};
  section.add(Verdict{(view.holds ? "It holds. " : "It does not hold. ") + view.says});
  if (Figure figure = agreement_figure(view); !figure.frames.empty()) {
    section.add(std::move(figure));
  }
  section.add(levels_table(view));
  return section;
}

}  // namespace

VerificationSectionRow describe_verification_verdict() { return {0, draw}; }

}  // namespace flexspline::reports
