#include <algorithm>

#include <fmt/format.h>

#include "conceal/conceal_reader.hpp"
#include "conceal/draw_effects.hpp"
#include "conceal/nuisances.hpp"
#include "flexspline/core/nearest_name.hpp"

namespace flexspline::studies {
namespace {

constexpr double kLargestSize = 0.5;

void read_sizes(TomlSection& section, ConcealDraw& draw) {
  const toml::node* node = section.node("size_fraction");
  if (node == nullptr) return;
  const auto range = section.numbers(*node, section.name_of("size_fraction"));
  if (!range) return;
  const bool sound = range->size() == 2 && range->front() > 0.0 &&
                     range->front() <= range->back() && range->back() <= kLargestSize;
  if (sound) {
    draw.smallest = range->front();
    draw.largest = range->back();
    return;
  }
  section.refuse("size_fraction",
                 fmt::format("'{}' is not a range of sizes", section.name_of("size_fraction")),
                 fmt::format("write [smallest, largest] between 0 and {}", kLargestSize));
}

/// True where the rig has what is drawn at once.
bool check_rig(TomlSection& section, const ConcealDraw& draw, Rig rig) {
  const std::vector<std::string> ids = drawable(draw, rig);
  const auto alone = [&](const std::string& id) { return partners(ids, id, rig).empty(); };
  if (ids.empty() && draw.one + draw.two > 0.0) {
    section.refuse("effects",
                   fmt::format("rig '{}' can conceal none of these effects", name_of(rig)),
                   "name others, or leave the key out for all");
    return false;
  }
  if (draw.two > 0.0 && std::ranges::any_of(ids, alone)) {
    section.refuse("effects",
                   fmt::format("rig '{}' has no two of these effects that differ", name_of(rig)),
                   "name more, or set two = 0");
    return false;
  }
  return true;
}

void check_effects(TomlSection& section, const ConcealDraw& draw, const std::vector<Rig>& rigs) {
  std::vector<std::string_view> known;
  for (const data::HiddenRow& row : data::hidden_effects()) {
    if (!row.id.starts_with("unknown:")) known.push_back(row.id);
  }
  for (const std::string& id : draw.effects) {
    if (std::ranges::find(known, std::string_view(id)) != known.end()) continue;
    section.refuse("effects", fmt::format("effect '{}' cannot be drawn", id),
                   suggestion(id, known));
    return;
  }
  for (const Rig rig : rigs) {
    if (!check_rig(section, draw, rig)) return;
  }
}

}  // namespace

std::optional<double> read_bounded(TomlSection& section, std::string_view key, double low,
                                   double high) {
  if (section.node(key) == nullptr) return std::nullopt;
  const std::optional<double> value = section.number(key);
  if (!value || (*value >= low && *value <= high)) return value;
  section.refuse(key, fmt::format("'{}' = {} is out of range", section.name_of(key), *value),
                 fmt::format("give a number between {} and {}", low, high));
  return std::nullopt;
}

std::optional<Rig> read_rig(TomlSection& section, std::string_view key) {
  const std::string name = section.required_text(key);
  const std::optional<Rig> rig = find_rig(name);
  static constexpr std::string_view known[] = {"locked", "free", "specimen", "servo"};
  if (!rig && !name.empty()) {
    section.refuse(key, fmt::format("unknown rig '{}'", name), suggestion(name, known));
  }
  return rig;
}

std::uint64_t read_seed(TomlSection& section) {
  constexpr std::int64_t kLargestSeed = 1LL << 53;
  return static_cast<std::uint64_t>(section.integer("seed", 0, kLargestSeed).value_or(1));
}

ConcealDraw read_draw(TomlSection& section, const std::vector<Rig>& rigs) {
  ConcealDraw draw;
  // Probabilities that are not written are none, so that a file says all there is.
  draw.none = read_bounded(section, "none", 0.0, 1e6).value_or(0.0);
  draw.one = read_bounded(section, "one", 0.0, 1e6).value_or(0.0);
  draw.two = read_bounded(section, "two", 0.0, 1e6).value_or(0.0);
  draw.unknown = read_bounded(section, "unknown", 0.0, 1e6).value_or(0.0);
  draw.contained = read_bounded(section, "contained", 0.0, 1e6).value_or(0.0);
  if (!(draw.none + draw.one + draw.two + draw.unknown + draw.contained > 0.0)) {
    section.refuse("none", fmt::format("'{}' has no probability", section.name_of("none")),
                   "give at least one of none, one, two, unknown, contained");
  }
  read_sizes(section, draw);
  draw.effects = section.texts("effects");
  check_effects(section, draw, rigs);
  section.refuse_unknown_keys();
  return draw;
}

std::map<std::string, double> read_nuisances(TomlSection& section) {
  std::map<std::string, double> values;
  for (const NuisanceSetting& setting : nuisance_settings()) {
    const auto value = section.quantity(setting.name, setting.dimension, setting.lowest);
    if (value) values[std::string(setting.name)] = *value;
  }
  section.refuse_unknown_keys();
  return values;
}

}  // namespace flexspline::studies
