#include "import/find_channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "flexspline/data/rig_channels.hpp"
#include "import/channel_units.hpp"
#include "import/short_names.hpp"
#include "readers/cell_text.hpp"
#include "tables/unit_words.hpp"

namespace flexspline::data {
namespace {

class Finder {
 public:
  Finder(const TableSurvey& table, std::vector<ColumnRole> roles, Rig rig,
         const std::vector<ColumnChoice>& choices)
      : table_(table), roles_(std::move(roles)), rig_(rig), choices_(choices) {}

  TableFinding find() {
    for (const ColumnChoice& choice : choices_) take(choice);
    if (!has(Quantity::time)) take_time();
    take_roles();
    ask_for_missing();
    note_the_rest();
    std::stable_partition(finding_.channels.begin(), finding_.channels.end(),
                          [](const FoundChannel& one) { return one.quantity == Quantity::time; });
    return std::move(finding_);
  }

 private:
  void ask(std::string problem, std::string remedy) {
    finding_.open.push_back({table_.words() + ": " + std::move(problem), std::move(remedy)});
  }

  bool has(Quantity quantity) const {
    return std::ranges::find(finding_.channels, quantity, &FoundChannel::quantity) !=
           finding_.channels.end();
  }

  bool is_taken(std::size_t column) const {
    return std::ranges::find(finding_.channels, column, &FoundChannel::column) !=
           finding_.channels.end();
  }

  bool is_refused(Quantity quantity) const {
    return std::ranges::any_of(choices_, [&](const ColumnChoice& one) {
      return one.quantity == quantity && one.column.empty();
    });
  }

  std::vector<std::size_t> columns_named(const std::string& name) const {
    std::vector<std::size_t> found;
    const auto& columns = table_.columns;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].column.name == name || name == fmt::format("col{}", i + 1)) found.push_back(i);
    }
    return found;
  }

  void take(const ColumnChoice& choice) {
    if (choice.column.empty()) return;
    const auto columns = columns_named(choice.column);
    if (columns.size() != 1) {
      ask(fmt::format("--map: {} columns are called '{}'", columns.size(), shown(choice.column)),
          fmt::format("give its number, col1 to col{}", table_.columns.size()));
      return;
    }
    ColumnRole role = roles_[columns[0]];
    if (choice.unit) role.unit = choice.unit;
    role.certainty = Certainty::stated;
    role.evidence = "by --map";
    add(choice.quantity, columns[0], role, choice.sign, choice.counts_per_rev, true);
  }

  void take_time() {
    const auto found = find_time(table_, roles_);
    if (found) {
      add(Quantity::time, *found, roles_[*found], 1.0, 0.0, true);
    } else {
      ask("no column is the time",
          fmt::format("state it: --map t=colN:s, of col1 to col{}", table_.columns.size()));
    }
  }

  std::vector<Quantity> needed() const {
    std::vector<Quantity> list;
    for (const ChannelChoice& choice : rig_channels(rig_).needs) {
      for (const auto& together : choice.alternatives) {
        list.insert(list.end(), together.begin(), together.end());
      }
    }
    return list;
  }

  void take_roles() {
    const std::vector<Quantity> needs = needed();
    for (const Quantity quantity : needs) take_role(quantity, true);
    for (const Quantity quantity : rig_channels(rig_).may_have) {
      if (std::ranges::find(needs, quantity) == needs.end()) take_role(quantity, false);
    }
  }

  void take_role(Quantity quantity, bool needed) {
    if (has(quantity) || is_refused(quantity)) return;
    std::vector<std::size_t> columns;
    for (std::size_t i = 0; i < roles_.size(); ++i) {
      const bool fits = quantity_of(roles_[i].meaning, rig_) == quantity;
      if (fits && !is_taken(i) && table_.columns[i].present > 0) columns.push_back(i);
    }
    prefer_named(columns);
    prefer_moving(columns);
    if (columns.size() == 1) {
      add(quantity, columns[0], roles_[columns[0]], 1.0, 0.0, needed);
    } else if (columns.size() > 1 && needed) {
      std::string list;
      for (const std::size_t i : columns)
        list += (list.empty() ? "" : ", ") + column_in_words(table_, i);
      ask(fmt::format("several columns may be the {}: {}", name_of(quantity), list),
          fmt::format("state which: --map {}=col{}", short_name(quantity), columns[0] + 1));
    }
  }

  /// One that has its side in its name goes before those that have none.
  void prefer_named(std::vector<std::size_t>& columns) const {
    std::vector<std::size_t> named = columns;
    std::erase_if(named, [&](std::size_t i) {
      return roles_[i].meaning.side == ColumnSide::unknown ||
             roles_[i].certainty == Certainty::likely;
    });
    if (named.size() == 1) columns = named;
  }

  /// Of the axes of a sensor the only one in which something happens.
  void prefer_moving(std::vector<std::size_t>& columns) {
    std::vector<std::size_t> moving = columns;
    std::erase_if(moving, [&](std::size_t i) { return !table_.columns[i].moves(); });
    if (moving.size() != 1 || columns.size() == 1) return;
    ColumnRole& role = roles_[moving[0]];
    role.certainty = std::max(role.certainty, Certainty::likely);
    role.evidence += fmt::format(", and of {} such the only one that changes", columns.size());
    columns = moving;
  }

  void add(Quantity quantity, std::size_t column, ColumnRole role, double sign, double counts,
           bool needed) {
    find_unit_of(quantity, table_, column, role);
    const std::string what = column_in_words(table_, column);
    const bool is_counts = role.unit && role.unit->symbol == "counts";
    const auto info = std::ranges::find(quantities(), quantity, &QuantityInfo::quantity);
    const bool fits = role.unit && std::ranges::find(info->dimensions, role.unit->dimension) !=
                                       info->dimensions.end();
    if (fits && (!is_counts || counts > 0.0)) {
      finding_.channels.push_back({quantity, column, *role.unit, counts, sign});
      finding_.inferred.push_back(
          {fmt::format("{}: {} is the {} in {}{}", table_.words(), what, name_of(quantity),
                       role.unit->symbol, sign < 0.0 ? ", its sign turned" : ""),
           role.certainty, role.evidence});
      return;
    }
    const std::string& written = table_.columns[column].column.unit;
    const std::string why =
        is_counts   ? "is in counts of an encoder, and nothing says how many a turn has"
        : role.unit ? fmt::format("is in {}, which no {} is", role.unit->symbol, name_of(quantity))
        : written.empty() ? std::string("has no unit")
                          : fmt::format("has the unknown unit '{}'", shown(written));
    const std::string option =
        fmt::format("state it: --map {}=col{}:{}", short_name(quantity), column + 1,
                    is_counts ? "counts/4096" : usual_unit(*info));
    if (needed) {
      ask(fmt::format("{}, the {}, {}", what, name_of(quantity), why), option);
    } else {
      finding_.notes.push_back(
          fmt::format("{}: {} is left out: it {}; {}", table_.words(), what, why, option));
    }
  }

  bool is_asked(const std::vector<Quantity>& together) const {
    return std::ranges::any_of(finding_.open, [&](const OpenQuestion& one) {
      return std::ranges::any_of(together, [&](Quantity quantity) {
        return one.remedy.find(fmt::format("{}=", short_name(quantity))) != std::string::npos;
      });
    });
  }

  void ask_for_missing() {
    for (const ChannelChoice& choice : rig_channels(rig_).needs) {
      const bool met = std::ranges::any_of(choice.alternatives, [&](const auto& together) {
        return std::ranges::all_of(together, [&](Quantity one) { return has(one); });
      });
      const bool asked = std::ranges::any_of(
          choice.alternatives, [&](const auto& together) { return is_asked(together); });
      if (met || asked) continue;
      const Quantity first = choice.alternatives[0][0];
      ask(fmt::format("no column is the {}, which rig '{}' needs", words_of(choice), name_of(rig_)),
          fmt::format(
              "state it: --map {}=colN:{}, or another --rig", short_name(first),
              usual_unit(*std::ranges::find(quantities(), first, &QuantityInfo::quantity))));
    }
  }

  void note_the_rest() {
    std::string list;
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      if (!is_taken(i)) list += (list.empty() ? "" : ", ") + column_in_words(table_, i);
    }
    if (!list.empty())
      finding_.notes.push_back(fmt::format("{}: left out: {}", table_.words(), list));
  }

  const TableSurvey& table_;
  std::vector<ColumnRole> roles_;
  Rig rig_;
  const std::vector<ColumnChoice>& choices_;
  TableFinding finding_;
};

}  // namespace

TableFinding find_channels(const TableSurvey& table, std::vector<ColumnRole> roles, Rig rig,
                           const std::vector<ColumnChoice>& choices) {
  return Finder(table, std::move(roles), rig, choices).find();
}

}  // namespace flexspline::data
