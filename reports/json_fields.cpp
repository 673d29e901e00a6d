#include "json_fields.hpp"

#include <nlohmann/json.hpp>

#include "flexspline/reports/artefacts.hpp"

namespace flexspline::reports {

using nlohmann::json;

const json& member(const json& object, const char* key) {
  static const json empty = json::object();
  if (!object.is_object()) return empty;
  const auto found = object.find(key);
  return found == object.end() || found->is_null() ? empty : *found;
}

std::string text_in(const json& object, const char* key) {
  const json& value = member(object, key);
  return value.is_string() ? value.get<std::string>() : std::string{};
}

double number_in(const json& object, const char* key) {
  const json& value = member(object, key);
  return value.is_number() ? value.get<double>() : kAbsent;
}

bool flag_in(const json& object, const char* key) {
  const json& value = member(object, key);
  return value.is_boolean() && value.get<bool>();
}

std::vector<double> numbers_in(const json& object, const char* key) {
  std::vector<double> numbers;
  for (const json& value : member(object, key)) {
    numbers.push_back(value.is_number() ? value.get<double>() : kAbsent);
  }
  return numbers;
}

std::vector<std::string> texts_in(const json& object, const char* key) {
  std::vector<std::string> texts;
  for (const json& value : member(object, key)) {
    if (value.is_string()) texts.push_back(value.get<std::string>());
  }
  return texts;
}

}  // namespace flexspline::reports
