#include "flexspline/data/model_toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "flexspline/core/effect.hpp"
#include "flexspline/core/law.hpp"
#include "flexspline/core/nearest_name.hpp"
#include "flexspline/core/rig.hpp"
#include "readers/toml_reader.hpp"

namespace flexspline::data {
namespace {

constexpr std::string_view kSchema = "flexspline-model/1";
constexpr std::array<std::string_view, 8> kKeys = {"schema", "note",      "rig", "origin",
                                                   "f",      "g_inverse", "h",   "effect"};
constexpr std::array<std::string_view, 5> kLawKeys = {"law", "scale", "knots", "coefficients",
                                                      "valid_to"};
constexpr std::string_view kUnity = "bounded_modulation";  // without coefficients: h = 1
constexpr std::array<std::string_view, 4> kEffectKeys = {"effect", "note", "across", "parameters"};
constexpr std::array<std::string_view, 2> kParameterKeys = {"name", "value"};

template <class Row>
std::vector<std::string_view> ids_of(std::span<const Row> rows) {
  std::vector<std::string_view> ids;
  for (const Row& row : rows) ids.push_back(row.id);
  return ids;
}

std::vector<double> numbers(TomlReader& reader, const toml::table& table, std::string_view key) {
  std::vector<double> values;
  const toml::array* list = reader.list(table, key);
  if (list == nullptr) return values;
  for (const toml::node& node : *list) {
    if (const auto value = reader.finite(node, key)) values.push_back(*value);
  }
  return values;
}

void check_law(TomlReader& reader, const toml::source_region& where, const LawSpec& law) {
  const auto known = ids_of(laws());
  if (std::ranges::find(known, law.law) == known.end()) {
    reader.refuse(where, fmt::format("unknown law '{}'", law.law), suggestion(law.law, known));
    return;
  }
  if (const auto made = make_law(law); !made) {
    reader.refuse(where, made.error().problem, made.error().remedy);
  }
}

LawSpec parse_law(TomlReader& reader, const toml::table& table,
                  const std::vector<Finding>& errors) {
  const std::size_t errors_before = errors.size();
  reader.check_keys(table, kLawKeys);
  LawSpec law;
  const auto id = reader.required_text(table, "law");
  law.law = id.value_or("");
  law.scale = reader.required_number(table, "scale").value_or(1.0);
  law.knots = numbers(reader, table, "knots");
  law.coefficients = numbers(reader, table, "coefficients");
  law.valid_to = reader.number(table, "valid_to").value_or(0.0);
  if (id && errors.size() == errors_before) check_law(reader, table.get("law")->source(), law);
  return law;
}

const EffectRow* effect_row(TomlReader& reader, const toml::table& entry, const std::string& id) {
  if (const auto row = find_effect(id)) return *row;
  reader.refuse(entry.get("effect")->source(), fmt::format("unknown effect '{}'", id),
                suggestion(id, ids_of(effects())));
  return nullptr;
}

std::optional<std::pair<std::string, double>> parse_parameter(TomlReader& reader,
                                                              const toml::node& node) {
  const toml::table* entry = node.as_table();
  if (entry == nullptr) {
    reader.refuse(node.source(), "a parameter is not a table", "write { name = …, value = … }");
    return std::nullopt;
  }
  reader.check_keys(*entry, kParameterKeys);
  const auto name = reader.required_text(*entry, "name");
  const auto value = reader.required_number(*entry, "value");
  if (!name || !value) return std::nullopt;
  return std::pair(*name, *value);
}

/// An effect takes its parameters by place, so name and order have to be those of its row.
void check_parameter(TomlReader& reader, const toml::source_region& where,
                     const std::pair<std::string, double>& given, const EffectParameter& wanted) {
  const auto& [name, value] = given;
  if (name != wanted.name) {
    reader.refuse(where, fmt::format("parameter '{}' stands where '{}' belongs", name, wanted.name),
                  "give the parameters by the names and in the order of 'list effects'");
  } else if (value < wanted.lower || value > wanted.upper) {
    reader.refuse(where, fmt::format("{} is {} {}, out of range", name, value, wanted.unit),
                  fmt::format("give {} to {}", wanted.lower, wanted.upper));
  }
}

void parse_parameters(TomlReader& reader, const toml::node& where, const toml::array& list,
                      const EffectRow& row, EffectSpec& effect) {
  const std::size_t group = row.parameters.size();
  for (const toml::node& node : list) {
    const auto parameter = parse_parameter(reader, node);
    if (!parameter) return;
    if (group > 0) {
      check_parameter(reader, node.source(), *parameter,
                      row.parameters[effect.parameters.size() % group]);
    }
    effect.parameters.push_back(*parameter);
  }
  const std::size_t given = effect.parameters.size();
  if (row.repeats ? group > 0 && given % group == 0 : given == group) return;
  reader.refuse(where.source(), fmt::format("effect '{}' has {} parameters", effect.effect, given),
                fmt::format("it takes {}{}", group, row.repeats ? " an element" : ""));
}

void parse_effects(TomlReader& reader, const toml::array& list, ModelSpec& model) {
  for (const toml::node& node : list) {
    const toml::table* entry = node.as_table();
    if (entry == nullptr) {
      reader.refuse(node.source(), "an effect is not a table", "write [[effect]] above it");
      continue;
    }
    reader.check_keys(*entry, kEffectKeys);
    const auto id = reader.required_text(*entry, "effect");
    if (!id) continue;
    const EffectRow* row = effect_row(reader, *entry, *id);
    const toml::array none;
    const toml::array* parameters = reader.list(*entry, "parameters");
    EffectSpec effect{*id, {}, reader.text(*entry, "note").value_or("")};
    effect.across = reader.truth(*entry, "across").value_or(false);
    if (effect.across && row != nullptr && row->site != Site::motor && row->site != Site::load) {
      reader.refuse(entry->get("across")->source(),
                    fmt::format("'{}' cannot stand across the transmission", *id),
                    "across is for effects that enter at the motor or the load");
    }
    if (row != nullptr) {
      parse_parameters(reader, *entry, parameters == nullptr ? none : *parameters, *row, effect);
    }
    model.effects.push_back(std::move(effect));
  }
}

/// rigid: a servo's transmission, which needs no law.
void parse_laws(TomlReader& reader, const toml::table& root, const std::vector<Finding>& errors,
                bool rigid, ModelSpec& model) {
  const std::array<std::pair<std::string_view, LawSpec*>, 3> places = {
      {{"f", &model.f}, {"g_inverse", &model.g_inverse}, {"h", &model.h}}};
  for (const auto& [name, law] : places) {
    if (const toml::table* table = reader.subtable(root, name)) {
      *law = parse_law(reader, *table, errors);
    } else if (name == "h") {
      law->law = kUnity;
    } else if (rigid) {
      *law = rigid_law();
    } else if (!root.contains(name)) {
      reader.refuse(root.source(), fmt::format("no [{}]", name), "a model has f and g_inverse");
    }
  }
}

std::optional<Rig> parse_bench(TomlReader& reader, const toml::table& table) {
  const auto name = reader.required_text(table, "rig");
  if (!name) return std::nullopt;
  const auto rig = find_rig(*name);
  if (!rig) {
    reader.refuse(table.get("rig")->source(), fmt::format("unknown rig '{}'", *name),
                  suggestion(*name, ids_of(rigs())));
  }
  return rig;
}

std::optional<double> parse_constant(TomlReader& reader, const toml::table& table,
                                     std::string_view name) {
  const auto value = reader.number(table, name);
  if (value && *value < 0.0) {
    reader.refuse(table.get(name)->source(), fmt::format("{} is {}", name, *value),
                  "a constant of a rig is not negative");
  }
  return value;
}

/// The bench and its constants; one that the rig does not use is refused.
void parse_rig(TomlReader& reader, const toml::table& table, RigModel& model) {
  const auto rig = parse_bench(reader, table);
  if (!rig) return;
  model.rig = *rig;
  std::vector<std::string_view> known = {"rig", "gear_ratio"};
  for (const DriveConstant& one : rig_row(*rig).constants) known.push_back(one.name);
  reader.check_keys(table, known);
  model.drive.gear_ratio = parse_constant(reader, table, "gear_ratio").value_or(1.0);
  for (const DriveConstant& one : rig_row(*rig).constants) {
    if (const auto value = parse_constant(reader, table, one.name)) {
      model.drive.*one.member = *value;
    }
  }
}

/// What the rig has constants for, and the laws; in the words of Origin.
void parse_origin(TomlReader& reader, const toml::table& table, RigModel& model) {
  std::vector<std::string_view> known = {"gear_ratio", "f", "g_inverse", "h"};
  for (const DriveConstant& one : rig_row(model.rig).constants) known.push_back(one.name);
  reader.check_keys(table, known);
  for (std::string_view name : known) {
    const auto word = reader.text(table, name);
    if (!word) continue;
    if (const auto origin = find_origin(*word)) {
      model.origin.emplace(name, *origin);
    } else {
      reader.refuse(table.get(name)->source(), fmt::format("unknown origin '{}'", *word),
                    "given, fitted, not identifiable or assumed");
    }
  }
}

void parse_root(TomlReader& reader, const toml::table& root, const std::vector<Finding>& errors,
                RigModel& model) {
  const auto schema = reader.required_text(root, "schema");
  if (schema && *schema != kSchema) {
    reader.refuse(root.get("schema")->source(), fmt::format("unknown schema '{}'", *schema),
                  fmt::format("this version reads '{}'", kSchema));
    return;
  }
  reader.check_keys(root, kKeys);
  if (const toml::table* table = reader.subtable(root, "rig")) parse_rig(reader, *table, model);
  if (const toml::table* table = reader.subtable(root, "origin")) {
    parse_origin(reader, *table, model);
  }
  ModelSpec& torsion = model.drive.torsion;
  parse_laws(reader, root, errors, model.rig == Rig::servo, torsion);
  if (const toml::array* list = reader.list(root, "effect")) parse_effects(reader, *list, torsion);
}

}  // namespace

Result<ModelSpec> parse_model(std::string_view text, const std::string& file) {
  auto model = parse_rig_model(text, file);
  if (!model) return tl::unexpected(model.error());
  return std::move(model->drive.torsion);
}

Result<RigModel> parse_rig_model(std::string_view text, const std::string& file) {
  std::vector<Finding> errors;
  TomlReader reader(file, errors);
  RigModel model;
  if (const auto root = reader.parse(text)) parse_root(reader, *root, errors, model);
  if (errors.empty()) return model;
  std::string findings;
  for (const Finding& finding : errors) findings += "\n  " + finding.message();
  return failure(ErrorCode::bad_data, fmt::format("model {} cannot be used:{}", file, findings));
}

}  // namespace flexspline::data
