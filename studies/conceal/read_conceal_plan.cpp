#include <algorithm>

#include <fmt/format.h>

#include "conceal/conceal_reader.hpp"
#include "conceal/generator.hpp"
#include "config/toml_root.hpp"
#include "flexspline/core/nearest_name.hpp"

namespace flexspline::studies {
namespace {

constexpr std::string_view kSchema = "flexspline-bench/1";

data::HiddenEffect read_effect(TomlSection& section, data::BenchKind rig) {
  data::HiddenEffect effect;
  effect.id = section.required_text("id");
  const auto size = read_bounded(section, "size_fraction", 0.0, 0.5);
  if (!section.has("size_fraction")) {
    section.refuse("id", fmt::format("'{}' is missing", section.name_of("size_fraction")),
                   "give the share of peak torque, e.g. size_fraction = 0.05");
  }
  effect.size_fraction = size.value_or(0.0);
  section.refuse_unknown_keys();
  std::vector<std::string> ids;
  for (const data::HiddenRow& row : data::hidden_effects()) {
    if (row.shows_on(rig)) ids.emplace_back(row.id);
  }
  const std::vector<std::string_view> known(ids.begin(), ids.end());
  if (!effect.id.empty() && std::ranges::find(ids, effect.id) == ids.end()) {
    section.refuse("id",
                   fmt::format("rig '{}' cannot conceal effect '{}'", name_of(rig), effect.id),
                   suggestion(effect.id, known));
  }
  return effect;
}

void read_effects(TomlSection& root, ConcealPlan& plan) {
  const toml::node* node = root.node("effects");
  if (node == nullptr) {
    root.refuse("effects", "'effects' is missing",
                "write effects = [] for nothing, a list of { id, size_fraction }, or \"draw\"");
    return;
  }
  if (const auto word = node->value<std::string>()) {
    if (*word == "draw") {
      plan.draw = ConcealDraw{};
    } else {
      root.refuse("effects", fmt::format("'effects' = \"{}\" is not known", *word),
                  "write \"draw\", or a list of { id, size_fraction }");
    }
    return;
  }
  const toml::array* list = node->as_array();
  if (list != nullptr && list->empty()) return;  // a list of tables has at least one
  for (TomlSection& section : root.tables("effects")) {
    plan.effects.push_back(read_effect(section, plan.rig));
    const data::HiddenEffect& added = plan.effects.back();
    if (std::ranges::count(plan.effects, added.id, &data::HiddenEffect::id) < 2) continue;
    section.refuse("id", fmt::format("effect '{}' is hidden twice", added.id), "give it one size");
  }
}

void read_disturbances(TomlSection& root, ConcealPlan& plan) {
  const std::vector<std::string> ids = disturbances_on(plan.rig);
  const std::vector<std::string_view> known(ids.begin(), ids.end());
  for (const std::string& id : root.texts("disturbances")) {
    if (std::ranges::find(ids, id) == ids.end()) {
      root.refuse("disturbances",
                  fmt::format("rig '{}' has no disturbance '{}'", name_of(plan.rig), id),
                  suggestion(id, known));
    } else if (std::ranges::find(plan.disturbances, id) != plan.disturbances.end()) {
      root.refuse("disturbances", fmt::format("disturbance '{}' stands there twice", id),
                  "name it once");
    } else {
      plan.disturbances.push_back(id);
    }
  }
}

std::optional<data::HiddenMotion> read_motion(TomlSection& section) {
  using enum data::HiddenMotion;
  const std::string name = section.required_text("motion");
  std::vector<std::string_view> known;
  for (const data::HiddenMotion motion : {sine, multisine, ramp, step_hold, staircase}) {
    known.push_back(data::name_of(motion));
    if (name == known.back()) return motion;
  }
  if (!name.empty()) {
    section.refuse("motion", fmt::format("unknown motion '{}'", name), suggestion(name, known));
  }
  return std::nullopt;
}

data::HiddenExcitation read_excitation(TomlSection& section) {
  data::HiddenExcitation excitation;
  excitation.motion = read_motion(section).value_or(excitation.motion);
  for (const char* key : {"amplitude", "frequency"}) {
    if (section.has(key)) continue;
    section.refuse(key, fmt::format("'{}' is missing", section.name_of(key)),
                   fmt::format("write {} = {{ value = …, unit = \"…\" }}", key));
  }
  excitation.amplitude = section.quantity("amplitude", Dimension::angle, 1e-9).value_or(1.0);
  excitation.frequency_hz = section.quantity("frequency", Dimension::frequency, 1e-6).value_or(1.0);
  excitation.cycles = read_bounded(section, "cycles", 0.5, 1e4).value_or(excitation.cycles);
  excitation.samples =
      static_cast<int>(section.integer("samples", 16, 10'000'000).value_or(excitation.samples));
  section.refuse_unknown_keys();
  return excitation;
}

void read_generator(TomlSection& root, ConcealPlan& plan, const std::filesystem::path& folder) {
  plan.generator = root.text("generator").value_or(plan.generator);
  std::vector<std::string_view> known;
  for (const GeneratorRow& row : generators()) known.push_back(row.id);
  if (find_generator(plan.generator) == nullptr) {
    root.refuse("generator", fmt::format("unknown generator '{}'", plan.generator),
                suggestion(plan.generator, known));
  }
  if (const auto source = root.text("source")) plan.source = folder / *source;
  if (plan.generator != "bench" && plan.source.empty()) {
    root.refuse("generator", fmt::format("generator '{}' has no source", plan.generator),
                "write source = \"…\": MuJoCo's script, or the recordings to splice into");
  }
  plan.change = root.text("change").value_or(plan.change);
}

ConcealPlan read_plan(TomlSection& root, const std::filesystem::path& folder) {
  ConcealPlan plan;
  check_schema(root, kSchema);
  read_generator(root, plan, folder);
  plan.rig = read_rig(root, "rig").value_or(Rig::locked);
  plan.seed = read_seed(root);
  read_effects(root, plan);
  read_disturbances(root, plan);
  if (auto draw = root.table("draw")) {
    const ConcealDraw drawn = read_draw(*draw, {plan.rig});
    if (!plan.draw) root.refuse("draw", "[draw] beside listed effects", "write effects = \"draw\"");
    plan.draw = drawn;
  }
  for (TomlSection& section : root.tables("excitation")) {
    plan.design.push_back(read_excitation(section));
  }
  if (auto nuisances = root.table("nuisances")) plan.nuisances = read_nuisances(*nuisances);
  root.refuse_unknown_keys();
  return plan;
}

}  // namespace

Result<ConcealReading> read_conceal_plan(const std::filesystem::path& file) {
  ConcealPlan plan;
  auto findings =
      read_toml_root(file, [&](TomlSection& root) { plan = read_plan(root, file.parent_path()); });
  if (!findings) return tl::unexpected(findings.error());
  ConcealReading reading{std::nullopt, *std::move(findings)};
  plan.file = file;
  if (reading.errors.empty()) reading.plan = std::move(plan);
  return reading;
}

Result<ConcealPlan> load_conceal_plan(const std::filesystem::path& file) {
  auto reading = read_conceal_plan(file);
  if (!reading) return tl::unexpected(reading.error());
  if (!reading->plan) return tl::unexpected(as_error(reading->errors));
  return *std::move(reading->plan);
}

}  // namespace flexspline::studies
