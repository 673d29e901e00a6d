#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include "flexspline/data/dataset.hpp"

namespace flexspline::data {

/// Takes values out of one TOML file. What is missing, misspelt or of another type becomes a
/// finding with the line and column where it stands.
class TomlReader {
 public:
  TomlReader(std::string file, std::vector<Finding>& errors);

  /// Nothing, and a finding, when the text is not TOML.
  std::optional<toml::table> parse(std::string_view text);

  /// A finding at a place of the file.
  Finding at(const toml::source_region& where, std::string problem, std::string remedy = {}) const;
  void refuse(const toml::source_region& where, std::string problem, std::string remedy = {});

  /// Every key of the table that is not known is refused, with the nearest one that is.
  void check_keys(const toml::table& table, std::span<const std::string_view> known);

  /// The value of a key; nothing when it is absent or, with a finding, of another type.
  std::optional<std::string> text(const toml::table& table, std::string_view key);
  std::optional<double> number(const toml::table& table, std::string_view key);
  std::optional<bool> truth(const toml::table& table, std::string_view key);
  const toml::table* subtable(const toml::table& table, std::string_view key);
  const toml::array* list(const toml::table& table, std::string_view key);

  /// The same for keys that have to be there.
  std::optional<std::string> required_text(const toml::table& table, std::string_view key);
  std::optional<double> required_number(const toml::table& table, std::string_view key);

  /// A finite number; a finding that calls it by this name otherwise.
  std::optional<double> finite(const toml::node& node, std::string_view name);

 private:
  void refuse_type(const toml::node& node, std::string_view name, std::string_view wanted);
  void refuse_absent(const toml::table& table, std::string_view key);

  std::string file_;
  std::vector<Finding>& errors_;
};

}  // namespace flexspline::data
