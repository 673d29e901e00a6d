#include "import/join_candidates.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "import/find_channels.hpp"
#include "import/find_rig.hpp"
#include "import/join_tables.hpp"

namespace flexspline::data {
namespace {

/// Whether a table has all that a bench needs.
bool is_whole(const Candidate& one, const ImportWish& wish) {
  auto rig = wish.rig;
  if (!rig) {
    const auto guess = find_rig_of(one.survey, one.roles, wish.choices);
    if (!guess) return false;
    rig = guess->rig;
  }
  return find_channels(one.survey, one.roles, *rig, wish.choices).open.empty();
}

std::string rates_in_words(std::span<const TableSurvey* const> tables) {
  std::string words;
  for (const TableSurvey* table : tables) {
    words += fmt::format("{}'{}' ({:.4g} Hz)", words.empty() ? "" : ", ", table->path,
                         rate_of(*table).value_or(0.0));
  }
  return words;
}

Inference joined_in_words(const TableSurvey& joined, std::span<const TableSurvey* const> tables,
                          bool stated) {
  return {fmt::format("{}: one recording, at the instants of the slowest of {}", joined.words(),
                      rates_in_words(tables)),
          stated ? Certainty::stated : Certainty::likely,
          stated
              ? "by --join"
              : "none alone has what a bench needs, together they have, and their clocks overlap"};
}

}  // namespace

void join_candidates(std::vector<Candidate>& tables, std::size_t first, ImportPlan& plan) {
  const ImportWish& wish = plan.wish;
  const auto begin = tables.begin() + static_cast<std::ptrdiff_t>(first);
  if (tables.end() - begin < 2) return;
  const auto whole = [&](const Candidate& one) { return is_whole(one, wish); };
  if (!wish.join && std::any_of(begin, tables.end(), whole)) return;
  std::stable_sort(begin, tables.end(), [](const Candidate& a, const Candidate& b) {
    return rate_of(a.survey).value_or(0.0) > rate_of(b.survey).value_or(0.0);
  });
  std::vector<const TableSurvey*> together{&begin->survey};
  for (auto next = begin + 1; next != tables.end(); ++next) {
    together.push_back(&next->survey);
    if (wish.join && next + 1 != tables.end()) continue;
    auto joined = join_tables(together);
    if (!joined) {
      if (wish.join) plan.open.push_back({"--join: " + joined.error().problem, "leave it out"});
      return;
    }
    std::vector<ColumnRole> roles = column_roles(*joined);
    Candidate one{*std::move(joined), std::move(roles)};
    if (!wish.join && !whole(one)) continue;
    plan.inferred.push_back(joined_in_words(one.survey, together, wish.join));
    *begin = std::move(one);
    tables.erase(begin + 1, next + 1);
    return;
  }
}

}  // namespace flexspline::data
