#include "flexspline/data/model_toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "flexspline/core/effect.hpp"
#include "flexspline/core/law.hpp"
#include "flexspline/core/nearest_name.hpp"
#include "flexspline/core/write_file.hpp"
#include "readers/toml_reader.hpp"
#include "readers/toml_text.hpp"

namespace flexspline::data {
namespace {

constexpr std::string_view kSchema = "flexspline-model/1";
constexpr std::array<std::string_view, 6> kKeys = {"schema",    "note", "f",
                                                   "g_inverse", "h",    "effect"};
constexpr std::array<std::string_view, 5> kLawKeys = {"law", "scale", "knots", "coefficients",
                                                      "valid_to"};
constexpr std::array<std::string_view, 2> kEffectKeys = {"effect", "parameters"};
constexpr std::array<std::string_view, 2> kParameterKeys = {"name", "value"};

std::string law_text(std::string_view name, const LawSpec& law) {
  if (law.law.empty()) return {};
  return fmt::format("\n[{}]\nlaw = {}\nscale = {}\nknots = {}\ncoefficients = {}\nvalid_to = {}\n",
                     name, toml_quoted(law.law), toml_number(law.scale), toml_list(law.knots),
                     toml_list(law.coefficients), toml_number(law.valid_to));
}

std::string effect_text(const EffectSpec& effect) {
  std::string text =
      fmt::format("\n[[effect]]\neffect = {}\nparameters = [\n", toml_quoted(effect.effect));
  for (const auto& [name, value] : effect.parameters) {
    text += fmt::format("  {{ name = {}, value = {} }},\n", toml_quoted(name), toml_number(value));
  }
  return text + "]\n";
}

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

void parse_parameter(TomlReader& reader, const toml::node& node, const EffectRow* row,
                     EffectSpec& effect) {
  const toml::table* entry = node.as_table();
  if (entry == nullptr) {
    reader.refuse(node.source(), "a parameter is not a table", "write { name = …, value = … }");
    return;
  }
  reader.check_keys(*entry, kParameterKeys);
  const auto name = reader.required_text(*entry, "name");
  const auto value = reader.required_number(*entry, "value");
  if (!name || !value) return;
  effect.parameters.emplace_back(*name, *value);
  if (row == nullptr) return;
  std::vector<std::string_view> known;
  for (const EffectParameter& parameter : row->parameters) known.push_back(parameter.name);
  if (std::ranges::find(known, *name) != known.end()) return;
  reader.refuse(entry->get("name")->source(),
                fmt::format("effect '{}' has no parameter '{}'", effect.effect, *name),
                suggestion(*name, known));
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
    EffectSpec effect{*id, {}};
    if (const toml::array* parameters = reader.list(*entry, "parameters")) {
      for (const toml::node& one : *parameters) parse_parameter(reader, one, row, effect);
    }
    model.effects.push_back(std::move(effect));
  }
}

void parse_laws(TomlReader& reader, const toml::table& root, const std::vector<Finding>& errors,
                ModelSpec& model) {
  const std::array<std::pair<std::string_view, LawSpec*>, 3> places = {
      {{"f", &model.f}, {"g_inverse", &model.g_inverse}, {"h", &model.h}}};
  for (const auto& [name, law] : places) {
    if (const toml::table* table = reader.subtable(root, name)) {
      *law = parse_law(reader, *table, errors);
    } else if (!root.contains(name) && name != "h") {
      reader.refuse(root.source(), fmt::format("no [{}]", name), "a model has f and g_inverse");
    }
  }
}

void parse_root(TomlReader& reader, const toml::table& root, const std::vector<Finding>& errors,
                ModelSpec& model) {
  const auto schema = reader.required_text(root, "schema");
  if (schema && *schema != kSchema) {
    reader.refuse(root.get("schema")->source(), fmt::format("unknown schema '{}'", *schema),
                  fmt::format("this version reads '{}'", kSchema));
    return;
  }
  reader.check_keys(root, kKeys);
  parse_laws(reader, root, errors, model);
  if (const toml::array* list = reader.list(root, "effect")) parse_effects(reader, *list, model);
}

}  // namespace

std::string model_toml(const ModelSpec& model) {
  std::string text = fmt::format("schema = \"{}\"\n", kSchema);
  text += law_text("f", model.f);
  text += law_text("g_inverse", model.g_inverse);
  text += law_text("h", model.h);
  for (const EffectSpec& effect : model.effects) text += effect_text(effect);
  return text;
}

Result<ModelSpec> parse_model(std::string_view text, const std::string& file) {
  std::vector<Finding> errors;
  TomlReader reader(file, errors);
  ModelSpec model;
  if (const auto root = reader.parse(text)) parse_root(reader, *root, errors, model);
  if (errors.empty()) return model;
  std::string findings;
  for (const Finding& finding : errors) findings += "\n  " + finding.message();
  return failure(ErrorCode::bad_data, fmt::format("model {} cannot be used:{}", file, findings));
}

Result<void> write_model(const std::filesystem::path& path, const ModelSpec& model) {
  return write_file(path, model_toml(model));
}

Result<ModelSpec> read_model(const std::filesystem::path& path) {
  const Result<std::string> text = read_file(path);
  if (!text) return tl::unexpected<Error>(text.error());
  return parse_model(*text, path.string());
}

}  // namespace flexspline::data
