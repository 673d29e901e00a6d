#include <algorithm>

#include <fmt/format.h>

#include "config/study_source.hpp"
#include "config/toml_root.hpp"
#include "flexspline/core/nearest_name.hpp"

namespace flexspline::studies {
namespace {

constexpr std::size_t kMostChecked = 500;  // points of a sweep

using Problem = std::optional<std::pair<std::string, std::string>>;  // and its remedy

void put(toml::table& table, const std::string& key, const SweepValue& value,
         const std::string& unit) {
  std::visit(
      [&](const auto& plain) {
        if (unit.empty())
          table.insert_or_assign(key, plain);
        else
          table.insert_or_assign(key, toml::table{{"value", plain}, {"unit", unit}});
      },
      value);
}

/// Writes a value under "a.b.c" of a table; tables that are not there are made.
void put_below(toml::table& table, std::string_view path, const SweepValue& value,
               const std::string& unit) {
  toml::table* at = &table;
  while (true) {
    const std::size_t dot = path.find('.');
    const std::string key(path.substr(0, dot));
    if (dot == std::string_view::npos) return put(*at, key, value, unit);
    if (at->get(key) == nullptr || !at->get(key)->is_table()) {
      at->insert_or_assign(key, toml::table{});
    }
    at = at->get(key)->as_table();
    path.remove_prefix(dot + 1);
  }
}

/// Of a list of tables, those that an id (or *) at the beginning of the path names.
Problem put_in_rows(toml::array& rows, const std::string& list, std::string_view path,
                    const SweepValue& value, const std::string& unit) {
  std::vector<std::string> ids;
  bool found = false;
  for (toml::node& row : rows) {
    toml::table* table = row.as_table();
    const auto id = table == nullptr ? std::nullopt : (*table)["id"].value<std::string>();
    if (!id) continue;
    ids.push_back(*id);
    for (const std::string& name : {*id + ".", std::string("*.")}) {
      if (!path.starts_with(name)) continue;
      put_below(*table, path.substr(name.size()), value, unit);
      found = true;
      break;
    }
  }
  if (found) return std::nullopt;
  const std::vector<std::string_view> known(ids.begin(), ids.end());
  const std::string named(path.substr(0, path.find('.')));
  return std::pair(fmt::format("no [[{}]] has the id that '{}.{}' begins with", list, list, path),
                   suggestion(named, known));
}

Problem put_at(toml::table& root, const SweepKey& key, const SweepValue& value) {
  const std::size_t dot = key.path.find('.');
  const std::string head = key.path.substr(0, dot);
  toml::node* node = root.get(head);
  toml::array* rows = node == nullptr ? nullptr : node->as_array();
  if (rows != nullptr && dot != std::string::npos) {
    return put_in_rows(*rows, head, std::string_view(key.path).substr(dot + 1), value, key.unit);
  }
  put_below(root, key.path, value, key.unit);
  return std::nullopt;
}

/// The study with one point of every sweep in its place.
Result<StudyConfig> study_at(const StudyConfig& study, const std::vector<std::size_t>& point) {
  const StudySource& source = *study.source;
  toml::table root = source.root;
  root.erase("sweep");
  for (std::size_t s = 0; s < point.size(); ++s) {
    const SweepAxis& sweep = study.sweeps[s];
    for (std::size_t k = 0; k < sweep.keys.size(); ++k) {
      const Problem problem = put_at(root, sweep.keys[k], sweep.points[point[s]][k]);
      if (problem) return failure(ErrorCode::bad_data, problem->first, problem->second);
    }
  }
  std::vector<data::Finding> findings;
  TomlSection section(root, "", source.file.string(), findings);
  StudyConfig made = read_tables(section, source);
  if (!findings.empty()) {
    return failure(ErrorCode::bad_data, findings.front().problem, findings.front().remedy);
  }
  made.file = study.file;
  return made;
}

std::string text_of(const SweepValue& value) {
  return std::visit([](const auto& plain) { return fmt::format("{}", plain); }, value);
}

}  // namespace

Result<StudyConfig> variant_study(const StudyConfig& study, std::size_t variant) {
  if (study.source == nullptr) return study;
  return study_at(study, point_of(study, variant));
}

void check_sweeps(TomlSection& root, const StudyConfig& study) {
  auto tables = root.tables("sweep");
  for (std::size_t s = 0; s < study.sweeps.size(); ++s) {
    const SweepAxis& sweep = study.sweeps[s];
    const std::size_t count = std::min(sweep.points.size(), kMostChecked);
    for (std::size_t p = 0; p < count; ++p) {
      std::vector<std::size_t> point(study.sweeps.size());
      point[s] = p;
      const auto made = study_at(study, point);
      if (made) continue;
      std::string at;
      for (std::size_t k = 0; k < sweep.keys.size(); ++k) {
        at += fmt::format("{}{} = {}", k > 0 ? ", " : "", sweep.keys[k].path,
                          text_of(sweep.points[p][k]));
      }
      const std::string problem = fmt::format("at {}: {}", at, made.error().problem);
      if (s < tables.size())
        tables[s].refuse("key", problem, made.error().remedy);
      else
        root.refuse("kind", problem, made.error().remedy);
      break;
    }
  }
}

}  // namespace flexspline::studies
