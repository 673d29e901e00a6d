#include "readers/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "flexspline/core/nearest_name.hpp"
#include "flexspline/core/nesting.hpp"

namespace flexspline::data {
namespace {

constexpr std::size_t kLargestText = std::size_t{4} << 20U;

std::string written(const toml::node& node) {
  std::ostringstream text;
  node.visit([&text](const auto& value) { text << value; });
  return text.str();
}

}  // namespace

TomlReader::TomlReader(std::string file, std::vector<Finding>& errors)
    : file_(std::move(file)), errors_(errors) {}

std::optional<toml::table> TomlReader::parse(std::string_view text) {
  if (text.size() > kLargestText) {
    refuse({}, fmt::format("it has {} bytes, where {} are the most", text.size(), kLargestText),
           "such a file is not written by hand: is it the right one?");
    return std::nullopt;
  }
  if (const auto flat = check_nesting(text); !flat) {
    refuse({}, flat.error().problem, flat.error().remedy);
    return std::nullopt;
  }
  try {
    return toml::parse(text, file_);
  } catch (const toml::parse_error& error) {
    refuse(error.source(), "not TOML: " + std::string(error.description()),
           "correct the syntax; see toml.io");
    return std::nullopt;
  }
}

Finding TomlReader::at(const toml::source_region& where, std::string problem,
                       std::string remedy) const {
  return {file_, static_cast<int>(where.begin.line), static_cast<int>(where.begin.column),
          std::move(problem), std::move(remedy)};
}

void TomlReader::refuse(const toml::source_region& where, std::string problem, std::string remedy) {
  errors_.push_back(at(where, std::move(problem), std::move(remedy)));
}

void TomlReader::check_keys(const toml::table& table, std::span<const std::string_view> known) {
  for (const auto& [key, value] : table) {
    if (std::ranges::find(known, key.str()) != known.end()) continue;
    refuse(key.source(), fmt::format("unknown key '{}'", key.str()), suggestion(key.str(), known));
  }
}

std::optional<std::string> TomlReader::text(const toml::table& table, std::string_view key) {
  const toml::node* node = table.get(key);
  if (node == nullptr) return std::nullopt;
  if (const auto* value = node->as_string()) return value->get();
  refuse_type(*node, key, "a text in quotes");
  return std::nullopt;
}

std::optional<double> TomlReader::number(const toml::table& table, std::string_view key) {
  const toml::node* node = table.get(key);
  return node == nullptr ? std::nullopt : finite(*node, key);
}

std::optional<bool> TomlReader::truth(const toml::table& table, std::string_view key) {
  const toml::node* node = table.get(key);
  if (node == nullptr) return std::nullopt;
  if (const auto* value = node->as_boolean()) return value->get();
  refuse_type(*node, key, "true or false");
  return std::nullopt;
}

const toml::table* TomlReader::subtable(const toml::table& table, std::string_view key) {
  const toml::node* node = table.get(key);
  if (node == nullptr) return nullptr;
  if (!node->is_table()) refuse_type(*node, key, fmt::format("a table, [{}]", key));
  return node->as_table();
}

const toml::array* TomlReader::list(const toml::table& table, std::string_view key) {
  const toml::node* node = table.get(key);
  if (node == nullptr) return nullptr;
  if (!node->is_array()) refuse_type(*node, key, "a list");
  return node->as_array();
}

std::optional<std::string> TomlReader::required_text(const toml::table& table,
                                                     std::string_view key) {
  if (!table.contains(key)) refuse_absent(table, key);
  return text(table, key);
}

std::optional<double> TomlReader::required_number(const toml::table& table, std::string_view key) {
  if (!table.contains(key)) refuse_absent(table, key);
  return number(table, key);
}

std::optional<double> TomlReader::finite(const toml::node& node, std::string_view name) {
  if (!node.is_number()) {
    refuse_type(node, name, "a number");
    return std::nullopt;
  }
  const toml::value<int64_t>* whole = node.as_integer();
  const double value =
      whole != nullptr ? static_cast<double>(whole->get()) : node.as_floating_point()->get();
  if (std::isfinite(value)) return value;
  refuse(node.source(), fmt::format("{} is {}, which is not finite", name, value),
         "give a finite number");
  return std::nullopt;
}

void TomlReader::refuse_type(const toml::node& node, std::string_view name,
                             std::string_view wanted) {
  std::ostringstream type;
  type << node.type();
  refuse(node.source(), fmt::format("{} is {}, of type {}", name, written(node), type.str()),
         fmt::format("give {}", wanted));
}

void TomlReader::refuse_absent(const toml::table& table, std::string_view key) {
  refuse(table.source(), fmt::format("no '{}' here", key), fmt::format("add {} = …", key));
}

}  // namespace flexspline::data
