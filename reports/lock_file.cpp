#include "lock_file.hpp"

#include <algorithm>

#include <toml++/toml.h>

#include "flexspline/core/nesting.hpp"

namespace flexspline::reports {
namespace {

std::vector<std::string> ids_in(const toml::table& table, std::string_view path) {
  std::vector<std::string> ids;
  const toml::array* rows = table.at_path(path).as_array();
  if (rows == nullptr) return ids;
  for (const toml::node& row : *rows) {
    const toml::table* columns = row.as_table();
    const auto id = columns != nullptr ? (*columns)["id"].value<std::string>() : std::nullopt;
    if (id) ids.push_back(*id);
  }
  return ids;
}

}  // namespace

LockFile parse_lock(const std::string& lock) {
  LockFile parsed;
  if (!check_nesting(lock)) return parsed;
  try {
    const toml::table table = toml::parse(lock);
    for (const char* path : {"study.name", "study.title", "title"}) {
      if (const auto title = table.at_path(path).value<std::string>()) parsed.title = *title;
    }
    parsed.inputs = ids_in(table, "study.input");
    parsed.estimators = ids_in(table, "study.estimator");
    if (const toml::table* cases = table["cases"].as_table()) {
      for (const auto& [key, depends_on] : *cases) parsed.cases.emplace_back(key.str());
    }
  } catch (const toml::parse_error&) {
    return {};
  }
  return parsed;
}

std::size_t place_in(const std::vector<std::string>& order, const std::string& id) {
  return static_cast<std::size_t>(std::find(order.begin(), order.end(), id) - order.begin());
}

}  // namespace flexspline::reports
