#include "config/toml_section.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "flexspline/core/nearest_name.hpp"

namespace flexspline::studies {

TomlSection::TomlSection(const toml::table& table, std::string path, std::string file,
                         std::vector<data::Finding>& findings)
    : table_(&table), path_(std::move(path)), file_(std::move(file)), findings_(&findings) {}

std::string TomlSection::name_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

const toml::node* TomlSection::node(std::string_view key) {
  if (std::ranges::find(known_, key) == known_.end()) known_.emplace_back(key);
  return table_->get(key);
}

void TomlSection::refuse_at(const toml::node& node, std::string problem, std::string remedy) {
  const toml::source_position at = node.source().begin;
  findings_->push_back({.file = file_,
                        .line = static_cast<int>(at.line),
                        .column = static_cast<int>(at.column),
                        .problem = std::move(problem),
                        .remedy = std::move(remedy)});
}

void TomlSection::refuse(std::string_view key, std::string problem, std::string remedy) {
  const toml::node* found = table_->get(key);
  refuse_at(found != nullptr ? *found : *table_, std::move(problem), std::move(remedy));
}

void TomlSection::refuse_unknown_keys() {
  const std::vector<std::string_view> names(known_.begin(), known_.end());
  for (const auto& [key, value] : *table_) {
    if (std::ranges::find(known_, key.str()) != known_.end()) continue;
    const toml::source_position at = key.source().begin;
    findings_->push_back({.file = file_,
                          .line = static_cast<int>(at.line),
                          .column = static_cast<int>(at.column),
                          .problem = fmt::format("unknown key '{}'", name_of(key.str())),
                          .remedy = suggestion(key.str(), names)});
  }
}

std::optional<std::string> TomlSection::text(std::string_view key) {
  const toml::node* found = node(key);
  if (found == nullptr) return std::nullopt;
  if (const auto* word = found->as_string()) return word->get();
  refuse_at(*found, fmt::format("'{}' is not text", name_of(key)), "write it in quotes");
  return std::nullopt;
}

std::string TomlSection::required_text(std::string_view key) {
  if (node(key) == nullptr) {
    refuse(key, fmt::format("'{}' is missing", name_of(key)), fmt::format("add {} = \"…\"", key));
    return {};
  }
  std::optional<std::string> found = text(key);
  if (found && found->empty()) refuse(key, fmt::format("'{}' is empty", name_of(key)), "name it");
  return found.value_or("");
}

std::optional<std::int64_t> TomlSection::integer(std::string_view key, std::int64_t low,
                                                 std::int64_t high) {
  const toml::node* found = node(key);
  if (found == nullptr) return std::nullopt;
  const auto* value = found->as_integer();
  if (value == nullptr) {
    refuse_at(*found, fmt::format("'{}' is not a whole number", name_of(key)),
              fmt::format("give one between {} and {}", low, high));
    return std::nullopt;
  }
  if (value->get() < low || value->get() > high) {
    refuse_at(*found, fmt::format("'{}' = {} is out of range", name_of(key), value->get()),
              fmt::format("give a whole number between {} and {}", low, high));
    return std::nullopt;
  }
  return value->get();
}

std::optional<bool> TomlSection::flag(std::string_view key) {
  const toml::node* found = node(key);
  if (found == nullptr) return std::nullopt;
  if (const auto* value = found->as_boolean()) return value->get();
  refuse_at(*found, fmt::format("'{}' is neither true nor false", name_of(key)),
            "write true or false");
  return std::nullopt;
}

std::vector<std::string> TomlSection::texts(std::string_view key) {
  const toml::node* found = node(key);
  if (found == nullptr) return {};
  const toml::array* list = found->as_array();
  if (list == nullptr) {
    refuse_at(*found, fmt::format("'{}' is not a list", name_of(key)), "write [\"a\", \"b\"]");
    return {};
  }
  std::vector<std::string> words;
  for (const toml::node& entry : *list) {
    if (const auto* word = entry.as_string())
      words.push_back(word->get());
    else
      refuse_at(entry, fmt::format("an entry of '{}' is not text", name_of(key)));
  }
  return words;
}

std::optional<TomlSection> TomlSection::table(std::string_view key) {
  const toml::node* found = node(key);
  if (found == nullptr) return std::nullopt;
  if (const toml::table* inner = found->as_table()) {
    return TomlSection(*inner, name_of(key), file_, *findings_);
  }
  refuse_at(*found, fmt::format("'{}' is not a table", name_of(key)));
  return std::nullopt;
}

std::vector<TomlSection> TomlSection::tables(std::string_view key) {
  const toml::node* found = node(key);
  if (found == nullptr) return {};
  std::vector<TomlSection> sections;
  const toml::array* list = found->as_array();
  if (list == nullptr || !list->is_homogeneous(toml::node_type::table)) {
    refuse_at(*found, fmt::format("'{}' is not a list of tables", name_of(key)),
              fmt::format("begin each one with [[{}]]", key));
    return sections;
  }
  for (std::size_t i = 0; i < list->size(); ++i) {
    sections.emplace_back(*list->get(i)->as_table(), fmt::format("{}[{}]", name_of(key), i + 1),
                          file_, *findings_);
  }
  return sections;
}

}  // namespace flexspline::studies
