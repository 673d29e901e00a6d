#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "flexspline/core/rig.hpp"
#include "flexspline/data/estimate_json.hpp"

namespace flexspline::data {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const LawSpec& law) {
  return {{"law", law.law},
          {"scale", law.scale},
          {"knots", law.knots},
          {"coefficients", law.coefficients},
          {"valid_to", law.valid_to}};
}

Json to_json(const EffectSpec& effect) {
  Json parameters = Json::array();
  for (const auto& [name, value] : effect.parameters) {
    parameters.push_back({{"name", name}, {"value", value}});
  }
  Json json = {{"effect", effect.effect}, {"parameters", std::move(parameters)}};
  if (!effect.note.empty()) json["note"] = effect.note;
  if (effect.across) json["across"] = true;
  return json;
}

LawSpec law_from(const Json& json) {
  LawSpec law;
  json.at("law").get_to(law.law);
  json.at("scale").get_to(law.scale);
  json.at("knots").get_to(law.knots);
  json.at("coefficients").get_to(law.coefficients);
  json.at("valid_to").get_to(law.valid_to);
  return law;
}

EffectSpec effect_from(const Json& json) {
  EffectSpec effect;
  json.at("effect").get_to(effect.effect);
  effect.note = json.value("note", "");
  effect.across = json.value("across", false);
  for (const Json& parameter : json.at("parameters")) {
    effect.parameters.emplace_back(parameter.at("name").get<std::string>(),
                                   parameter.at("value").get<double>());
  }
  return effect;
}

}  // namespace

Json to_json(const ModelSpec& model) {
  Json effects = Json::array();
  for (const EffectSpec& effect : model.effects) effects.push_back(to_json(effect));
  return {{"f", to_json(model.f)},
          {"g_inverse", to_json(model.g_inverse)},
          {"h", to_json(model.h)},
          {"effects", std::move(effects)}};
}

Json to_json(const RigModel& model) {
  Json json = to_json(model.drive.torsion);
  Json rig = {{"rig", name_of(model.rig)}, {"gear_ratio", model.drive.gear_ratio}};
  for (const DriveConstant& one : rig_row(model.rig).constants) {
    rig[std::string(one.name)] = model.drive.*one.member;
  }
  json["rig"] = std::move(rig);
  return json;
}

Result<ModelSpec> model_from_json(const Json& json) {
  try {
    ModelSpec model;
    model.f = law_from(json.at("f"));
    model.g_inverse = law_from(json.at("g_inverse"));
    model.h = law_from(json.at("h"));
    for (const Json& effect : json.at("effects")) model.effects.push_back(effect_from(effect));
    return model;
  } catch (const Json::exception& error) {
    return failure(ErrorCode::bad_data, fmt::format("not a model: {}", error.what()),
                   "fit it again");
  }
}

}  // namespace flexspline::data
