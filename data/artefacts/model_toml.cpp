#include <fmt/format.h>

#include "flexspline/core/write_file.hpp"
#include "flexspline/data/model_toml.hpp"
#include "readers/toml_text.hpp"

namespace flexspline::data {
namespace {

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

}  // namespace

std::string model_toml(const ModelSpec& model) {
  std::string text = "schema = \"flexspline-model/1\"\n";
  text += law_text("f", model.f);
  text += law_text("g_inverse", model.g_inverse);
  text += law_text("h", model.h);
  for (const EffectSpec& effect : model.effects) text += effect_text(effect);
  return text;
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
