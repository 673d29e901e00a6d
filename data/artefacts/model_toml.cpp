#include <fmt/format.h>

#include "flexspline/core/rig.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/data/model_toml.hpp"
#include "readers/toml_text.hpp"

namespace flexspline::data {
namespace {

std::string law_text(std::string_view name, const LawSpec& law) {
  if (law.law.empty() || law == rigid_law()) return {};
  return fmt::format("\n[{}]\nlaw = {}\nscale = {}\nknots = {}\ncoefficients = {}\nvalid_to = {}\n",
                     name, toml_quoted(law.law), toml_number(law.scale), toml_list(law.knots),
                     toml_list(law.coefficients), toml_number(law.valid_to));
}

std::string effect_text(const EffectSpec& effect) {
  std::string text = fmt::format("\n[[effect]]\neffect = {}\n", toml_quoted(effect.effect));
  if (!effect.note.empty()) text += fmt::format("note = {}\n", toml_quoted(effect.note));
  if (effect.across) text += "across = true\n";
  text += "parameters = [\n";
  for (const auto& [name, value] : effect.parameters) {
    text += fmt::format("  {{ name = {}, value = {} }},\n", toml_quoted(name), toml_number(value));
  }
  return text + "]\n";
}

std::string rig_text(const RigModel& model) {
  std::string text =
      fmt::format("\n[rig]\nrig = {}\ngear_ratio = {}\n", toml_quoted(name_of(model.rig)),
                  toml_number(model.drive.gear_ratio));
  for (const DriveConstant& one : rig_row(model.rig).constants) {
    const double value = model.drive.*one.member;
    if (value == 0.0) continue;
    text += fmt::format("{} = {}  # {}, {}\n", one.name, toml_number(value), one.unit, one.says);
  }
  return text;
}

std::string origin_text(const RigModel& model) {
  if (model.origin.empty()) return {};
  std::string text = "\n[origin]\n";
  for (const auto& [name, origin] : model.origin) {
    text += fmt::format("{} = {}\n", name, toml_quoted(name_of(origin)));
  }
  return text;
}

std::string laws_and_effects(const ModelSpec& model) {
  std::string text;
  text += law_text("f", model.f);
  text += law_text("g_inverse", model.g_inverse);
  text += law_text("h", model.h);
  for (const EffectSpec& effect : model.effects) text += effect_text(effect);
  return text;
}

constexpr std::string_view kFirstLine = "schema = \"flexspline-model/1\"\n";

}  // namespace

std::string model_toml(const ModelSpec& model) {
  return std::string(kFirstLine) + laws_and_effects(model);
}

std::string model_toml(const RigModel& model) {
  return std::string(kFirstLine) + rig_text(model) + origin_text(model) +
         laws_and_effects(model.drive.torsion);
}

Result<void> write_model(const std::filesystem::path& path, const ModelSpec& model) {
  return write_file(path, model_toml(model));
}

Result<void> write_model(const std::filesystem::path& path, const RigModel& model) {
  return write_file(path, model_toml(model));
}

Result<RigModel> read_rig_model(const std::filesystem::path& path) {
  const Result<std::string> text = read_file(path);
  if (!text) return tl::unexpected<Error>(text.error());
  return parse_rig_model(*text, path.string());
}

Result<ModelSpec> read_model(const std::filesystem::path& path) {
  const Result<std::string> text = read_file(path);
  if (!text) return tl::unexpected<Error>(text.error());
  return parse_model(*text, path.string());
}

}  // namespace flexspline::data
