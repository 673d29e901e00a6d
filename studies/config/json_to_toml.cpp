#include "config/json_to_toml.hpp"

#include <sstream>

#include <toml++/toml.h>
#include <nlohmann/json.hpp>

#include "config/study_json.hpp"
#include "flexspline/studies/study_config.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

toml::table to_table(const ordered_json& object);

/// Hands the TOML form of a JSON value to put.
template <class Put>
void with_toml(const ordered_json& value, const Put& put);

toml::array to_array(const ordered_json& list) {
  toml::array array;
  for (const ordered_json& entry : list) {
    with_toml(entry, [&](auto node) { array.push_back(std::move(node)); });
  }
  return array;
}

template <class Put>
void with_toml(const ordered_json& value, const Put& put) {
  if (value.is_object())
    put(to_table(value));
  else if (value.is_array())
    put(to_array(value));
  else if (value.is_string())
    put(value.get<std::string>());
  else if (value.is_boolean())
    put(value.get<bool>());
  else if (value.is_number_integer())
    put(value.get<std::int64_t>());
  else if (value.is_number())
    put(value.get<double>());
}

toml::table to_table(const ordered_json& object) {
  toml::table table;
  for (const auto& [key, value] : object.items()) {
    with_toml(value, [&, name = key](auto node) { table.insert_or_assign(name, std::move(node)); });
  }
  return table;
}

}  // namespace

std::string toml_text(const ordered_json& object) {
  std::ostringstream out;
  out << to_table(object) << '\n';
  return out.str();
}

std::string describe_study(const StudyConfig& study) { return toml_text(to_json(study)); }

}  // namespace flexspline::studies
