#pragma once

#include <algorithm>
#include <string>

#include <nlohmann/json.hpp>

namespace flexspline::studies {

/// Where a value does not obey a schema of draft 4, by the keywords that the project's schemas use;
/// empty where it does.
class JsonSchema {
 public:
  using Json = nlohmann::json;

  explicit JsonSchema(Json schema) : root_(std::move(schema)) {}

  std::string complaint(const Json& value) const { return at(root_, value, "$"); }

 private:
  static bool is(const std::string& type, const Json& value) {
    if (type == "integer") return value.is_number_integer();
    if (type == "number") return value.is_number();
    if (type == "null") return value.is_null();
    return type == value.type_name();
  }

  static std::string wrong_type(const Json& schema, const Json& value) {
    if (!schema.contains("type")) return "";
    const Json& type = schema.at("type");
    const Json types = type.is_array() ? type : Json::array({type});
    const bool any = std::ranges::any_of(types, [&](const Json& one) { return is(one, value); });
    return any ? "" : std::string("is of type ") + value.type_name();
  }

  static std::string out_of_range(const Json& schema, const Json& value) {
    if (value.is_number()) {
      const auto number = value.get<double>();
      const bool open = schema.value("exclusiveMinimum", false);
      if (number > schema.value("maximum", number)) return "is above its maximum";
      if (number < schema.value("minimum", number)) return "is below its minimum";
      if (open && number == schema.at("minimum").get<double>()) return "is at its open minimum";
    }
    if (value.is_array()) {
      if (value.size() < schema.value("minItems", value.size())) return "has too few items";
      if (value.size() > schema.value("maxItems", value.size())) return "has too many items";
    }
    if (value.is_string() && value.get<std::string>().size() < schema.value("minLength", 0U)) {
      return "is too short";
    }
    return "";
  }

  static std::string not_listed(const Json& schema, const Json& value) {
    if (!schema.contains("enum")) return "";
    const Json& list = schema.at("enum");
    return std::ranges::find(list, value) == list.end() ? "is none of " + list.dump() : "";
  }

  const Json& resolved(const Json& schema) const {
    if (!schema.contains("$ref")) return schema;
    return root_.at(Json::json_pointer(schema.at("$ref").get<std::string>().substr(1)));
  }

  std::string in_object(const Json& schema, const Json& value, const std::string& place) const {
    for (const Json& key : schema.value("required", Json::array())) {
      if (!value.contains(key.get<std::string>())) return place + " lacks " + key.dump();
    }
    const Json properties = schema.value("properties", Json::object());
    const Json others = schema.value("additionalProperties", Json(true));
    for (const auto& [key, one] : value.items()) {
      const bool known = properties.contains(key);
      if (!known && others.is_boolean()) {
        if (!others.get<bool>()) return place + " has an unknown key " + key;
        continue;
      }
      const auto found = at(known ? properties.at(key) : others, one, place + "/" + key);
      if (!found.empty()) return found;
    }
    return "";
  }

  std::string in_array(const Json& schema, const Json& value, const std::string& place) const {
    if (!schema.contains("items")) return "";
    for (std::size_t i = 0; i < value.size(); ++i) {
      const auto found = at(schema.at("items"), value[i], place + "/" + std::to_string(i));
      if (!found.empty()) return found;
    }
    return "";
  }

  std::string at(const Json& given, const Json& value, const std::string& place) const {
    const Json& schema = resolved(given);
    for (const std::string& found :
         {wrong_type(schema, value), out_of_range(schema, value), not_listed(schema, value)}) {
      if (!found.empty()) return place + " " + found;
    }
    if (value.is_object()) return in_object(schema, value, place);
    return value.is_array() ? in_array(schema, value, place) : "";
  }

  Json root_;
};

}  // namespace flexspline::studies
