#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <numbers>
#include <set>

#include "flexspline/data/import.hpp"
#include "import/column_roles.hpp"
#include "import/find_channels.hpp"
#include "import/find_rig.hpp"
#include "import/import_parts.hpp"
#include "import/join_candidates.hpp"

namespace flexspline::data {
namespace {

constexpr std::size_t kFewestRows = 16;

bool is_picked(const TableSurvey& table, const std::vector<std::string>& picks) {
  return picks.empty() || std::ranges::find(picks, table.path) != picks.end();
}

/// Letters that a file system or a spreadsheet may stumble over become '_'.
std::string plain_id(std::string text) {
  std::ranges::replace_if(
      text,
      [](unsigned char letter) { return !std::isalnum(letter) && !std::strchr("-_.", letter); },
      '_');
  if (text.empty() || !std::isalnum(static_cast<unsigned char>(text.front()))) text = "r" + text;
  return text;
}

class Planner {
 public:
  explicit Planner(const ImportWish& wish) { plan_.wish = wish; }

  Result<ImportPlan> plan() {
    for (const auto& file : plan_.wish.files) {
      auto tables = survey_file(file, plan_.wish.request);
      if (!tables) return tl::unexpected(tables.error());
      const std::size_t before = tables_.size();
      for (TableSurvey& table : *tables) consider(std::move(table));
      join_candidates(tables_, before, plan_);
    }
    plan_.constants = plan_.wish.constants;
    if (tables_.empty()) {
      ask("no table has a time and 16 rows of numbers",
          known_paths_.empty() ? "look at the notes: what was read of the files"
                               : "--table takes one of: " + known_paths_);
    } else {
      find_rig();
    }
    if (plan_.rig) find_all_channels();
    if (plan_.rig && plan_.open.empty()) settle();
    plan_.parts = std::make_shared<const ImportParts>(std::move(parts_));
    return std::move(plan_);
  }

 private:
  void ask(std::string problem, std::string remedy) {
    plan_.open.push_back({std::move(problem), std::move(remedy)});
  }

  void consider(TableSurvey table) {
    for (const std::string& note : table.notes) plan_.notes.push_back(table.words() + ": " + note);
    table.notes.clear();
    if (!table.path.empty()) known_paths_ += (known_paths_.empty() ? "" : ", ") + table.path;
    if (!is_picked(table, plan_.wish.tables)) return;
    if (table.rows < kFewestRows) {
      plan_.notes.push_back(fmt::format("{}: left out: {} rows, where {} are the fewest",
                                        table.words(), table.rows, kFewestRows));
      return;
    }
    std::vector<ColumnRole> roles = column_roles(table);
    std::vector<ColumnRole> looked = roles;
    const bool timed = find_time(table, looked) || is_time_chosen();
    if (!timed && table.columns.size() < 2) {
      plan_.notes.push_back(table.words() + ": left out: a single column");
      return;
    }
    tables_.push_back({std::move(table), std::move(roles)});
  }

  bool is_time_chosen() const {
    return std::ranges::any_of(plan_.wish.choices, [](const ColumnChoice& one) {
      return one.quantity == Quantity::time && !one.column.empty();
    });
  }

  void find_rig() {
    if (plan_.wish.rig) {
      plan_.rig = plan_.wish.rig;
      plan_.inferred.push_back(
          {fmt::format("rig {}", name_of(*plan_.rig)), Certainty::stated, "by --rig"});
      return;
    }
    for (const Candidate& one : tables_) {
      const auto guess = find_rig_of(one.survey, one.roles, plan_.wish.choices);
      if (!guess) continue;
      plan_.rig = guess->rig;
      plan_.inferred.push_back(
          {fmt::format("rig {}", name_of(guess->rig)), Certainty::likely, guess->evidence});
      return;
    }
    const bool several = tables_.size() > 1;
    std::string columns;
    for (const Candidate& one : tables_) {
      columns += several ? fmt::format("{}{}: ", columns.empty() ? "" : "; ", one.survey.words())
                         : std::string();
      columns += columns_in_words(one.survey);
    }
    ask(fmt::format("which bench it is cannot be told from {}", columns),
        fmt::format("state it: --rig locked|free|specimen|servo (flexspline list rigs), and what "
                    "columns are: --map theta_m=colN:deg{}",
                    several ? "; --join makes one of the tables of a file, and columns then "
                              "have its numbers; of several files: export what belongs together "
                              "on one clock"
                            : ""));
  }

  void find_all_channels() {
    for (Candidate& one : tables_) {
      TableFinding finding = find_channels(one.survey, one.roles, *plan_.rig, plan_.wish.choices);
      const bool other = tables_.size() > 1 && plan_.wish.tables.empty() && !finding.open.empty() &&
                         finding.channels.size() < 3;
      if (other) {
        plan_.notes.push_back(
            fmt::format("{}: left out: {}", one.survey.words(), finding.open[0].problem));
        continue;
      }
      append(plan_.inferred, finding.inferred);
      append(plan_.notes, finding.notes);
      append(plan_.open, finding.open);
      parts_.tables.push_back({std::move(one.survey), "", std::move(finding.channels)});
    }
    if (parts_.tables.empty()) {
      ask(fmt::format("no table has what rig '{}' needs; its channels must lie in one table",
                      name_of(*plan_.rig)),
          "see the notes; --join makes one of the tables of a file; state columns by --map, or "
          "merge the tables where they were written");
    }
  }

  template <class T>
  static void append(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
  }

  void settle() {
    keep_common_channels();
    name_recordings();
    find_ratio_of_gear();
    if (*plan_.rig == Rig::specimen) keep_one_effort();
    for (const FoundTable& table : parts_.tables) {
      for (const FoundChannel& one : table.channels) {
        const ColumnSurvey& survey = table.survey.columns[one.column];
        const std::size_t absent = table.survey.rows - survey.present;
        if (absent == 0 || one.quantity == Quantity::time) continue;
        parts_.marks_absent = true;
        plan_.notes.push_back(
            fmt::format("{}: {} of {} cells of {} are absent; their rows are marked valid = 0",
                        table.survey.words(), absent, table.survey.rows,
                        column_in_words(table.survey, one.column)));
      }
    }
  }

  /// The format has one list of channels for all recordings: those that every table has, in the
  /// units of the first.
  void keep_common_channels() {
    for (const FoundChannel& one : parts_.tables[0].channels) {
      const auto lacks = std::ranges::find_if(parts_.tables, [&](const FoundTable& table) {
        return std::ranges::find(table.channels, one.quantity, &FoundChannel::quantity) ==
               table.channels.end();
      });
      if (lacks == parts_.tables.end()) {
        parts_.channels.push_back(one);
      } else {
        plan_.notes.push_back(fmt::format("the {} is left out: {} has none", name_of(one.quantity),
                                          lacks->survey.words()));
      }
    }
    for (FoundTable& table : parts_.tables) {
      std::vector<FoundChannel> kept;
      for (const FoundChannel& one : parts_.channels) {
        kept.push_back(*std::ranges::find(table.channels, one.quantity, &FoundChannel::quantity));
      }
      table.channels = std::move(kept);
    }
  }

  /// transmitted_torque and torque, or torsion and angle, are alternatives: the first is kept.
  void keep_one_effort() {
    for (const std::vector<Quantity>& rivals :
         {std::vector{Quantity::torsion, Quantity::displacement, Quantity::angle},
          std::vector{Quantity::transmitted_torque, Quantity::torque, Quantity::force}}) {
      std::vector<Quantity> there;
      for (const Quantity one : rivals) {
        if (std::ranges::find(parts_.channels, one, &FoundChannel::quantity) !=
            parts_.channels.end()) {
          there.push_back(one);
        }
      }
      if (there.size() < 2) continue;
      ask(fmt::format("both {} and {} are there, and a specimen has one", name_of(there[0]),
                      name_of(there[1])),
          fmt::format("leave one out: --map {}=none", name_of(there[1])));
    }
  }

  void name_recordings() {
    std::set<std::string> taken;
    for (FoundTable& table : parts_.tables) {
      std::string id = plain_id(table.survey.file.stem().string());
      const auto same_file = std::ranges::count_if(parts_.tables, [&](const FoundTable& other) {
        return other.survey.file == table.survey.file;
      });
      if (same_file > 1) id.append("-").append(plain_id(table.survey.path));
      while (!taken.insert(id).second) id += "_";
      table.id = id;
    }
  }

  const FoundChannel* channel(const FoundTable& table, Quantity quantity) const {
    const auto found = std::ranges::find(table.channels, quantity, &FoundChannel::quantity);
    return found == table.channels.end() ? nullptr : &*found;
  }

  void find_ratio_of_gear() {
    const bool geared = *plan_.rig == Rig::locked || *plan_.rig == Rig::free;
    if (!geared) return;
    if (plan_.constants.contains("gear_ratio")) {
      plan_.inferred.push_back({fmt::format("gear ratio {:.6g}", plan_.constants["gear_ratio"]),
                                Certainty::stated, "by --ratio"});
      return;
    }
    const FoundTable& table = parts_.tables[0];
    const FoundChannel* motor = channel(table, Quantity::motor_angle);
    const FoundChannel* load = channel(table, Quantity::load_angle);
    const auto guess =
        *plan_.rig == Rig::free && motor != nullptr && load != nullptr
            ? find_ratio(table.survey, motor->column, motor->sign * motor->unit.factor,
                         load->column, load->sign * load->unit.factor)
            : std::nullopt;
    if (!guess) {
      ask(fmt::format("the gear ratio cannot be found{}",
                      *plan_.rig == Rig::locked ? ": the output is held" : " from the two angles"),
          "state it: --ratio N, in motor turns per output turn");
      return;
    }
    plan_.constants["gear_ratio"] = std::abs(guess->ratio);
    plan_.inferred.push_back({fmt::format("gear ratio {:.6g}", std::abs(guess->ratio)),
                              Certainty::likely, guess->evidence});
    if (guess->ratio < 0.0) turn_load_angle();
  }

  /// Both shafts must be positive in one direction.
  void turn_load_angle() {
    const auto turn = [](std::vector<FoundChannel>& channels) {
      std::ranges::find(channels, Quantity::load_angle, &FoundChannel::quantity)->sign *= -1.0;
    };
    turn(parts_.channels);
    for (FoundTable& table : parts_.tables) turn(table.channels);
    plan_.inferred.push_back({"load_angle has sign = -1", Certainty::likely,
                              "it falls while the motor's angle rises; a torque of the output may "
                              "need the same"});
  }

  ImportPlan plan_;
  ImportParts parts_;
  std::vector<Candidate> tables_;
  std::string known_paths_;
};

}  // namespace

std::string_view name_of(Certainty certainty) {
  switch (certainty) {
    case Certainty::stated:
      return "stated";
    case Certainty::sure:
      return "sure";
    case Certainty::likely:
      break;
  }
  return "likely";
}

Result<ImportPlan> plan_import(const ImportWish& wish) { return Planner(wish).plan(); }

}  // namespace flexspline::data
