#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

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

bool may_be(const QuantityInfo& info, Dimension dimension) {
  return std::ranges::find(info.dimensions, dimension) != info.dimensions.end();
}

std::string symbols_of(const QuantityInfo& info) {
  std::string symbols;
  for (const Dimension dimension : info.dimensions) {
    if (!symbols.empty()) symbols += ", ";
    symbols += flexspline::symbols_of(dimension);
  }
  return may_be(info, Dimension::angle) ? symbols + ", counts" : symbols;
}

/// An angle by an encoder's counts.
std::optional<Unit> counts(TomlReader& reader, const toml::table& entry) {
  const auto per_turn = reader.required_number(entry, "counts_per_rev");
  if (!per_turn) return std::nullopt;
  if (*per_turn >= 1.0 && *per_turn <= 1e12) {
    return Unit{kCounts, Dimension::angle, 2.0 * std::numbers::pi / *per_turn, 0.0};
  }
  reader.refuse(entry.get("counts_per_rev")->source(),
                fmt::format("counts_per_rev is {}", *per_turn), "give 1 to 1e12 counts a turn");
  return std::nullopt;
}

std::optional<Unit> unit_of(TomlReader& reader, const toml::table& entry,
                            const QuantityInfo* info) {
  const auto symbol = reader.required_text(entry, "unit");
  if (!symbol || info == nullptr) return std::nullopt;
  if (*symbol == kCounts && may_be(*info, Dimension::angle)) return counts(reader, entry);
  if (const toml::node* unused = entry.get("counts_per_rev")) {
    reader.refuse(unused->source(), fmt::format("counts_per_rev beside the unit '{}'", *symbol),
                  "it belongs to an angle with unit = \"counts\"");
  }
  const auto& where = entry.get("unit")->source();
  const std::string remedy = fmt::format("give one of: {}", symbols_of(*info));
  const auto unit = find_unit(*symbol);
  if (!unit) {
    reader.refuse(where, fmt::format("unknown unit '{}'", *symbol), remedy);
    return std::nullopt;
  }
  if (may_be(*info, unit->dimension)) return unit;
  reader.refuse(where,
                fmt::format("unit '{}' is of dimension {}, but a {} is of dimension {}", *symbol,
                            name_of(unit->dimension), info->name, name_of(info->dimensions[0])),
                remedy);
  return std::nullopt;
}

/// sign, scale and offset of an entry, each checked; those of a plain channel where absent.
struct Correction {
  double sign = 1.0;
  double scale = 1.0;
  double offset = 0.0;
};

/// What of a channel may be corrected: not the direction of time or of a temperature, and nothing
/// of a mark that is 0 or 1.
void refuse_correction(TomlReader& reader, const toml::table& entry, const QuantityInfo& info) {
  const bool mark = info.quantity == Quantity::valid || info.quantity == Quantity::drive_enabled;
  const bool one_way = info.quantity == Quantity::time || info.quantity == Quantity::temperature;
  for (const std::string_view key : {"sign", "scale", "offset"}) {
    const toml::node* node = entry.get(key);
    if (node == nullptr || !(mark || (one_way && key == "sign"))) continue;
    reader.refuse(node->source(), fmt::format("a {} takes no {}", info.name, key), "leave it out");
  }
}

Correction correction(TomlReader& reader, const toml::table& entry, const QuantityInfo& info) {
  refuse_correction(reader, entry, info);
  Correction wanted{reader.number(entry, "sign").value_or(1.0),
                    reader.number(entry, "scale").value_or(1.0),
                    reader.number(entry, "offset").value_or(0.0)};
  if (std::abs(wanted.sign) != 1.0) {
    reader.refuse(entry.get("sign")->source(), fmt::format("sign is {}", wanted.sign),
                  "give 1 or -1");
  }
  if (!(wanted.scale >= 1e-12 && wanted.scale <= 1e12)) {
    reader.refuse(entry.get("scale")->source(), fmt::format("scale is {}", wanted.scale),
                  "give 1e-12 to 1e12; a direction belongs into sign");
    wanted.scale = 1.0;
  }
  return wanted;
}

/// In this order after the unit; the offset is a difference in the unit of the channel.
Unit corrected(const Unit& unit, const Correction& by) {
  const double factor = by.scale * by.sign;
  return {unit.symbol, unit.dimension, factor * unit.factor,
          factor * unit.offset + by.offset * unit.factor};
}

std::optional<Channel> parse_channel(TomlReader& reader, const toml::key& column,
                                     const toml::node& node) {
  const toml::table* entry = node.as_table();
  if (entry == nullptr) {
    reader.refuse(node.source(), fmt::format("channel '{}' is not a table", column.str()),
                  R"(write it as { quantity = "time", unit = "s" })");
    return std::nullopt;
  }
  static constexpr std::array<std::string_view, 7> known = {
      "quantity", "unit", "note", "sign", "scale", "offset", "counts_per_rev"};
  reader.check_keys(*entry, known);
  const QuantityInfo* info = quantity_of(reader, *entry);
  const auto unit = unit_of(reader, *entry, info);
  if (info == nullptr || !unit) return std::nullopt;
  const Correction by = correction(reader, *entry, *info);
  return Channel{std::string(column.str()), info->quantity, corrected(*unit, by),
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
      continue;
    }
    channels.push_back(std::move(channel));
  }
  return channels;
}

}  // namespace flexspline::data
