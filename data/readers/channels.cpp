#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "flexspline/core/nearest_name.hpp"
#include "readers/description_parts.hpp"

namespace flexspline::data {
namespace {

const QuantityInfo* quantity_of(TomlReader& reader, const toml::table& entry) {
  const auto name = reader.required_text(entry, "quantity");
  if (!name) return nullptr;
  const auto found = std::ranges::find(quantities(), *name, &QuantityInfo::name);
  if (found != quantities().end()) return &*found;
  std::vector<std::string_view> names;
  for (const QuantityInfo& info : quantities()) names.push_back(info.name);
  reader.refuse(entry.get("quantity")->source(), fmt::format("unknown quantity '{}'", *name),
                suggestion(*name, names));
  return nullptr;
}

std::string symbols_of(const QuantityInfo& info) {
  std::string symbols;
  for (const Dimension dimension : info.dimensions) {
    if (!symbols.empty()) symbols += ", ";
    symbols += flexspline::symbols_of(dimension);
  }
  return symbols;
}

std::optional<Unit> unit_of(TomlReader& reader, const toml::table& entry,
                            const QuantityInfo* info) {
  const auto symbol = reader.required_text(entry, "unit");
  if (!symbol || info == nullptr) return std::nullopt;
  const auto& where = entry.get("unit")->source();
  const std::string remedy = fmt::format("give one of: {}", symbols_of(*info));
  const auto unit = find_unit(*symbol);
  if (!unit) {
    reader.refuse(where, fmt::format("unknown unit '{}'", *symbol), remedy);
    return std::nullopt;
  }
  if (std::ranges::find(info->dimensions, unit->dimension) != info->dimensions.end()) return unit;
  reader.refuse(where,
                fmt::format("unit '{}' is of dimension {}, but a {} is of dimension {}", *symbol,
                            name_of(unit->dimension), info->name, name_of(info->dimensions[0])),
                remedy);
  return std::nullopt;
}

std::optional<Channel> parse_channel(TomlReader& reader, const toml::key& column,
                                     const toml::node& node) {
  const toml::table* entry = node.as_table();
  if (entry == nullptr) {
    reader.refuse(node.source(), fmt::format("channel '{}' is not a table", column.str()),
                  R"(write it as { quantity = "time", unit = "s" })");
    return std::nullopt;
  }
  static constexpr std::array<std::string_view, 3> known = {"quantity", "unit", "note"};
  reader.check_keys(*entry, known);
  const QuantityInfo* info = quantity_of(reader, *entry);
  const auto unit = unit_of(reader, *entry, info);
  if (info == nullptr || !unit) return std::nullopt;
  return Channel{std::string(column.str()), info->quantity, *unit,
                 static_cast<int>(column.source().begin.line)};
}

}  // namespace

std::vector<Channel> parse_channels(TomlReader& reader, const toml::table& table) {
  std::vector<std::pair<toml::source_position, Channel>> placed;
  for (const auto& [column, node] : table) {
    const auto channel = parse_channel(reader, column, node);
    if (channel) placed.emplace_back(column.source().begin, *channel);
  }
  // toml++ sorts by key; a person reads from the top.
  std::ranges::sort(placed, {}, &std::pair<toml::source_position, Channel>::first);
  std::vector<Channel> channels;
  for (auto& [position, channel] : placed) {
    const auto twin = std::ranges::find(channels, channel.quantity, &Channel::quantity);
    if (twin != channels.end()) {
      reader.refuse({position, position, nullptr},
                    fmt::format("columns '{}' and '{}' are both the {}", twin->column,
                                channel.column, name_of(channel.quantity)),
                    "name each quantity once; a column without an entry is ignored");
    }
    channels.push_back(std::move(channel));
  }
  return channels;
}

}  // namespace flexspline::data
