#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include "flexspline/core/units.hpp"
#include "flexspline/data/dataset.hpp"

namespace flexspline::studies {

/// Reads one table of a TOML file strictly: each getter notes its key as known, so that every other
/// key can be refused, and what is wrong is gathered with its line and column.
class TomlSection {
 public:
  TomlSection(const toml::table& table, std::string path, std::string file,
              std::vector<data::Finding>& findings);

  bool has(std::string_view key) const { return table_->contains(key); }
  std::optional<std::string> text(std::string_view key);
  std::string required_text(std::string_view key);
  std::optional<std::int64_t> integer(std::string_view key, std::int64_t low, std::int64_t high);
  std::optional<bool> flag(std::string_view key);
  std::vector<std::string> texts(std::string_view key);
  /// { value = 0.2, unit = "deg" } in SI, at least low (SI).
  std::optional<double> quantity(std::string_view key, Dimension dimension, double low);
  /// { values = [0.1, 0.2], unit = "deg" } in SI, all positive, at least one.
  std::vector<double> quantities(std::string_view key, Dimension dimension);
  std::optional<TomlSection> table(std::string_view key);
  std::vector<TomlSection> tables(std::string_view key);
  const toml::node* node(std::string_view key);
  /// A table that is not there, as if it stood empty under that key.
  TomlSection absent(std::string_view key, const toml::table& nothing) const {
    return {nothing, name_of(key), file_, *findings_};
  }
  /// Whether nothing was refused so far, in the whole file.
  bool clean() const { return findings_->empty(); }

  /// Every key no getter asked for is an error. Call it last.
  void refuse_unknown_keys();
  /// An error at a key of this section, or at the section itself where it has no such key.
  void refuse(std::string_view key, std::string problem, std::string remedy = {});
  void refuse_at(const toml::node& node, std::string problem, std::string remedy = {});
  /// "input[2].truth".
  std::string name_of(std::string_view key) const;
  /// The unit named by key `unit` of this table.
  std::optional<Unit> unit(Dimension dimension);
  std::optional<double> number(std::string_view key);
  std::optional<std::vector<double>> numbers(const toml::node& list, const std::string& what);
  const toml::table& raw() const { return *table_; }

 private:
  const toml::table* table_;
  std::string path_;
  std::string file_;
  std::vector<data::Finding>* findings_;
  std::vector<std::string> known_;
};

}  // namespace flexspline::studies
