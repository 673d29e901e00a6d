#include "config/differing_keys.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "flexspline/core/nesting.hpp"

namespace flexspline::studies {
namespace {

using Values = std::map<std::string, std::string>;  ///< by path

constexpr std::size_t kLongest = 60;  // bytes of a value that are shown
constexpr std::size_t kBefore = 12;   // of them what stands before a difference far behind

bool is_inside_letter(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

/// On one line, numbers in their shortest form.
std::string text_of(const toml::node& node) {
  std::vector<std::string> parts;
  if (const auto* list = node.as_array()) {
    for (const toml::node& one : *list) parts.push_back(text_of(one));
    return fmt::format("[{}]", fmt::join(parts, ", "));
  }
  if (const auto* table = node.as_table()) {
    for (const auto& [key, one] : *table) {
      parts.push_back(fmt::format("{} = {}", key.str(), text_of(one)));
    }
    return fmt::format("{{{}}}", fmt::join(parts, ", "));
  }
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* text = node.as_string()) return fmt::format("'{}'", text->get());
  std::ostringstream out;
  node.visit([&](const auto& value) { out << value; });
  return out.str();
}

void add(const toml::node& node, const std::string& path, Values& values);

void add_table(const toml::table& table, const std::string& path, Values& values) {
  for (const auto& [key, node] : table) {
    add(node, path.empty() ? std::string(key.str()) : fmt::format("{}.{}", path, key.str()),
        values);
  }
}

void add_tables(const toml::array& list, const std::string& path, Values& values) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const toml::table& one = *list[i].as_table();
    const std::string id = one["id"].value_or(std::string());
    const bool told = !id.empty() && seen.insert(id).second;
    add_table(one, fmt::format("{}[{}]", path, told ? id : std::to_string(i + 1)), values);
  }
}

void add(const toml::node& node, const std::string& path, Values& values) {
  if (const auto* table = node.as_table()) return add_table(*table, path, values);
  const auto* list = node.as_array();
  if (list != nullptr && list->is_array_of_tables()) return add_tables(*list, path, values);
  values.emplace(path, text_of(node));
}

std::optional<Values> values_of(const std::string& text) {
  if (!check_nesting(text)) return std::nullopt;
  try {
    Values values;
    add_table(toml::parse(text), "", values);
    return values;
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

/// As much of a value as fits, from shortly before where it differs.
std::string shown(const std::string& value, std::size_t differs) {
  if (value.size() <= kLongest) return value;
  std::size_t from = differs + kBefore > kLongest ? differs - std::min(differs, kBefore) : 0;
  while (from > 0 && from < value.size() && is_inside_letter(value[from])) --from;
  std::size_t to = std::min(value.size(), from + kLongest);
  while (to < value.size() && is_inside_letter(value[to])) --to;
  return fmt::format("{}{}{}", from > 0 ? "…" : "", value.substr(from, to - from),
                     to < value.size() ? "…" : "");
}

std::string difference(const std::string& key, const std::string* there, const std::string* here) {
  if (there == nullptr)
    return fmt::format("{} is {} here and not stated there", key, shown(*here, 0));
  if (here == nullptr)
    return fmt::format("{} is {} there and not stated here", key, shown(*there, 0));
  const auto at = std::ranges::mismatch(*there, *here).in1 - there->begin();
  const auto differs = static_cast<std::size_t>(at);
  return fmt::format("{} is {} there and {} here", key, shown(*there, differs),
                     shown(*here, differs));
}

const std::string* found(const Values& values, const std::string& key) {
  const auto at = values.find(key);
  return at == values.end() ? nullptr : &at->second;
}

}  // namespace

std::vector<std::string> differing_keys(const std::string& there, const std::string& here) {
  if (there == here) return {};
  const auto old_values = values_of(there);
  const auto new_values = values_of(here);
  if (!old_values || !new_values) return {"what they say is not the same"};
  std::set<std::string> keys;
  for (const auto& [key, value] : *old_values) keys.insert(key);
  for (const auto& [key, value] : *new_values) keys.insert(key);
  std::vector<std::string> list;
  for (const std::string& key : keys) {
    const std::string* before = found(*old_values, key);
    const std::string* now = found(*new_values, key);
    if (before != nullptr && now != nullptr && *before == *now) continue;
    list.push_back(difference(key, before, now));
  }
  return list;
}

}  // namespace flexspline::studies
