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
              "the virtual bench.",
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
              "Table II: the bench.",
              {{"quantity", "", 3}, {"value", "", 5}, {"unit", "", 3}},
              {}};
  for (const TableTwoRow& row : paper.table_2)
    table.rows.push_back({row.name, row.value, row.unit});
  return table;
}

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
  for (const PaperFigure& figure : paper.figures) section.add(paper_figure(figure));
  if (!paper.table_2.empty()) section.fold("Table II: the bench", table_two(paper));
  return section;
}

}  // namespace

SectionRow describe_paper() { return {60, draw}; }

}  // namespace flexspline::reports
