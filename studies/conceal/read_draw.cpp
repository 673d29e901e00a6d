#include <algorithm>

#include <fmt/format.h>

#include "conceal/conceal_reader.hpp"
#include "conceal/draw_effects.hpp"
#include "conceal/nuisances.hpp"
#include "flexspline/core/nearest_name.hpp"

namespace flexspline::studies {
namespace {

constexpr double kLargestSize = 0.5;

struct KindKey {
  const char* key;
  double ConcealDraw::*share;
};

constexpr KindKey kKindKeys[] = {{"none", &ConcealDraw::none},
                                 {"one", &ConcealDraw::one},
                                 {"two", &ConcealDraw::two},
                                 {"unknown", &ConcealDraw::unknown},
                                 {"contained", &ConcealDraw::contained},
                                 {"variant", &ConcealDraw::variant},
                                 {"incident", &ConcealDraw::incident}};

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
bool check_rig(TomlSection& section, const ConcealDraw& draw, data::BenchKind rig) {
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

void check_effects(TomlSection& section, const ConcealDraw& draw,
                   const std::vector<data::BenchKind>& rigs) {
  std::vector<std::string_view> known;
  for (const data::HiddenRow& row : data::hidden_effects()) {
    if (data::hidden_class(row.id) == data::HiddenClass::named) known.push_back(row.id);
  }
  for (const std::string& id : draw.effects) {
    if (std::ranges::find(known, std::string_view(id)) != known.end()) continue;
    section.refuse("effects", fmt::format("effect '{}' cannot be drawn", id),
                   suggestion(id, known));
    return;
  }
  for (const data::BenchKind rig : rigs) {
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

std::vector<std::string_view> bench_kind_names() {
  std::vector<std::string_view> names;
  for (const data::BenchKind kind : data::bench_kinds()) names.push_back(name_of(kind));
  return names;
}

std::optional<data::BenchKind> read_rig(TomlSection& section, std::string_view key) {
  const std::string name = section.required_text(key);
  const std::optional<data::BenchKind> rig = data::find_bench_kind(name);
  if (!rig && !name.empty()) {
    section.refuse(key, fmt::format("unknown rig '{}'", name),
                   suggestion(name, bench_kind_names()));
  }
  return rig;
}

std::uint64_t read_seed(TomlSection& section) {
  constexpr std::int64_t kLargestSeed = 1LL << 53;
  return static_cast<std::uint64_t>(section.integer("seed", 0, kLargestSeed).value_or(1));
}

ConcealDraw read_draw(TomlSection& section, const std::vector<data::BenchKind>& rigs) {
  ConcealDraw draw;
  // Probabilities that are not written are none, so that a file says all there is.
  for (const KindKey& one : kKindKeys) {
    draw.*one.share = read_bounded(section, one.key, 0.0, 1e6).value_or(0.0);
  }
  if (!(whole(draw) > 0.0)) {
    section.refuse("none", fmt::format("'{}' has no probability", section.name_of("none")),
                   "give at least one of none, one, two, unknown, contained, variant, incident");
  }
  draw.disturbed = read_bounded(section, "disturbed", 0.0, 1.0).value_or(0.0);
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
