#include <cmath>
#include <cstdlib>

#include "figures/study_figures.hpp"
#include "flexspline/reports/section.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

/// Leading significant digits, up to those known, to which ours rounds to the known value.
int agreeing_digits(const Fact& fact) {
  char* end = nullptr;
  const double published = std::strtod(fact.published.c_str(), &end);
  if (end == fact.published.c_str() || !std::isfinite(fact.value)) return 0;
  int agreeing = 0;
  for (int count = 1; count <= fact.digits; ++count) {
    if (same(rounded(fact.value, count), rounded(published, count))) agreeing = count;
  }
  return agreeing;
}

Table facts_table(const Paper& paper) {
  Table table{"paper-facts",
              "What can be computed from the paper's own numbers, beside the values known before.",
              {{"fact", "", 3},
               {"ours", "", 5},
               {"known", "", 3},
               {"unit", "", 3},
               {"digits known", "", 0},
               {"digits that agree", "", 0}},
              {}};
  for (const Fact& fact : paper.facts) {
    table.rows.push_back({fact.says, fact.value, fact.published, fact.unit,
                          fact.digits > 0 ? static_cast<double>(fact.digits) : kAbsent,
                          fact.digits > 0 ? static_cast<double>(agreeing_digits(fact)) : kAbsent});
  }
  return table;
}

Table table_one(const Paper& paper) {
  Table table{"table-1",
              "Table I: coefficients as published, and as the paper's method recovers them from "
              "the virtual bench. Wrong in it: nothing that could be recomputed, but it claims "
              "more than one loop can give. Single coefficients have no more digits than "
              "their standard deviations leave; only their sum over the range is determined.",
              {{"coefficient", "", 3},
               {"published", "", 5},
               {"recovered", "", 5},
               {"std", "", 2},
               {"off by", "std", 2},
               {"unit", "", 3}},
              {}};
  for (const TableOneRow& row : paper.table_1) {
    table.rows.push_back({row.name, row.published, row.recovered, row.std,
                          (row.recovered - row.published) / row.std, row.unit});
  }
  return table;
}

Table table_two(const Paper& paper) {
  Table table{"table-2",
              "Table II: the bench as printed, and what the virtual bench takes from it.",
              {{"quantity", "", 3},
               {"printed", "", 5},
               {"ours", "", 5},
               {"unit", "", 3},
               {"remark", "", 3}},
              {}};
  for (const TableTwoRow& row : paper.table_2) {
    table.rows.push_back({row.name, row.value, row.ours, row.unit, row.says});
  }
  return table;
}

Table slips_table(const Paper& paper) {
  Table table{"slips",
              "Slips of the text, with what was presumably meant.",
              {{"where", "", 3}, {"printed", "", 3}, {"meant, or true", "", 3}},
              {}};
  for (const Slip& slip : paper.slips) {
    table.rows.push_back({slip.where, slip.printed, slip.meant});
  }
  return table;
}

constexpr const char* kSides =
    "Figures 4 to 12, side by side. Left: what the printed numbers give, Table I along the sine "
    "that "
    "was asked for; the measured curves of the print are not available as numbers. Right: the same "
    "experiment on the virtual bench, with noise and encoder, and, where it is asked what was "
    "estimated, the full trajectory beside the paper's fit.";

std::string verdict_of(const Paper& paper) {
  std::size_t known = 0, agree = 0;
  for (const Fact& fact : paper.facts) {
    if (fact.digits <= 0) continue;
    ++known;
    if (agreeing_digits(fact) == fact.digits) ++agree;
  }
  return std::to_string(agree) + " of " + std::to_string(known) +
         " facts about the paper's numbers are recomputed to every digit that is known of them.";
}

std::optional<Section> draw(const StudyView& view) {
  if (!view.artefacts().paper) return std::nullopt;
  const Paper& paper = *view.artefacts().paper;
  Section section{"paper-section", "The paper, reproduced", {}};
  if (!paper.facts.empty()) section.add(Verdict{verdict_of(paper)});
  Figure beyond = table_one_figure(paper);
  if (!beyond.frames.empty()) section.add(std::move(beyond));
  if (!paper.facts.empty()) section.add(facts_table(paper));
  if (!paper.table_1.empty()) section.add(table_one(paper));
  if (!paper.table_2.empty()) section.add(table_two(paper));
  if (!paper.slips.empty()) section.add(slips_table(paper));
  if (!paper.figures.empty()) section.add(Paragraph{kSides});
  for (const PaperFigure& figure : paper.figures) section.add(paper_figure(view, figure));
  return section;
}

}  // namespace

SectionRow describe_paper() { return {60, draw}; }

}  // namespace flexspline::reports
