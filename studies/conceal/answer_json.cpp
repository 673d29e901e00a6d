#include <cctype>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "flexspline/core/estimate.hpp"
#include "flexspline/studies/conceal.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

/// What is not known of others' recordings stands there as null.
double number_or(const ordered_json& json, const char* key, double other) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? found->get<double>() : other;
}

std::optional<data::HiddenEquation> find_equation(const std::string& name) {
  using enum data::HiddenEquation;
  for (const data::HiddenEquation one : {torsion, load, motor, drive}) {
    if (data::name_of(one) == name) return one;
  }
  return std::nullopt;
}

ordered_json values_of(const std::vector<data::HiddenParameter>& parameters) {
  ordered_json values = ordered_json::object();
  for (const data::HiddenParameter& one : parameters) values[key_of(one)] = one.value;
  return values;
}

ordered_json to_json(const std::optional<data::HiddenPlace>& place) {
  if (!place) return nullptr;
  return {{"recording", place->recording},
          {"interval_s", {place->from_s, place->to_s}},
          {"duration_s", place->duration_s}};
}

std::optional<data::HiddenPlace> place_in(const ordered_json& json) {
  if (!json.is_object()) return std::nullopt;
  return data::HiddenPlace{
      json.at("recording").get<std::string>(), json.at("interval_s").at(0).get<double>(),
      json.at("interval_s").at(1).get<double>(), json.at("duration_s").get<double>()};
}

std::vector<AppliedDisturbance> disturbances_in(const ordered_json& answer) {
  std::vector<AppliedDisturbance> all;
  if (!answer.contains("disturbances")) return all;
  for (const auto& [id, values] : answer["disturbances"].items()) {
    AppliedDisturbance& one = all.emplace_back(AppliedDisturbance{id, {}});
    for (const auto& [name, value] : values.items()) {
      one.parameters.push_back({name, value.get<double>(), {}});
    }
  }
  return all;
}

data::HiddenFinding finding(const ordered_json& answer, std::size_t index) {
  data::HiddenFinding found;
  found.id = answer.at("effects").at(index).get<std::string>();
  found.size_fraction = answer.at("size").at(index).get<double>();
  const ordered_json& coordinate = answer.at("coordinate").at(index);
  if (coordinate.is_string()) found.coordinate = coordinate.get<std::string>();
  if (answer.contains("equation")) {
    found.equation = find_equation(answer["equation"].at(index)).value_or(found.equation);
  }
  if (answer.contains("info") && answer["info"].contains(found.id)) {
    for (const auto& [key, value] : answer["info"][found.id].items()) {
      if (value.is_number()) found.parameters.push_back({key, value.get<double>(), {}});
    }
  }
  if (answer.contains("names")) found.names = answer["names"].at(index);
  if (answer.contains("place")) found.place = place_in(answer["place"].at(index));
  return found;
}

}  // namespace

std::string key_of(const data::HiddenParameter& parameter) {
  std::string key = parameter.name;
  if (!parameter.unit.empty()) key += "_" + parameter.unit;
  for (char& letter : key) {
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0) letter = '_';
  }
  return key;
}

ordered_json to_json(const ConcealedAnswer& answer) {
  ordered_json json = {{"generator", answer.generator},
                       {"source", answer.source},
                       {"change", answer.change},
                       {"rig", name_of(answer.rig)},
                       {"effects", ordered_json::array()},
                       {"size", ordered_json::array()},
                       {"coordinate", ordered_json::array()},
                       {"info", ordered_json::object()},
                       {"noise_std_nm", answer.noise_std},
                       {"twins", answer.twins},
                       {"tau_max", answer.peak_torque},
                       {"equation", ordered_json::array()},
                       {"names", ordered_json::array()},
                       {"place", ordered_json::array()},
                       {"disturbances", ordered_json::object()},
                       {"best_rmse_nm", answer.best_rmse},
                       {"at_output", answer.at_output},
                       {"seed", answer.seed},
                       {"dataset_sha256", answer.dataset_sha256}};
  for (const data::HiddenFinding& effect : answer.effects) {
    json["effects"].push_back(effect.id);
    json["size"].push_back(effect.size_fraction);
    json["coordinate"].push_back(effect.coordinate.empty() ? ordered_json(nullptr)
                                                           : ordered_json(effect.coordinate));
    json["equation"].push_back(data::name_of(effect.equation));
    json["names"].push_back(effect.names);
    json["place"].push_back(to_json(effect.place));
    json["info"][effect.id] = values_of(effect.parameters);
  }
  for (const AppliedDisturbance& one : answer.disturbances) {
    json["disturbances"][one.id] = values_of(one.parameters);
  }
  return json;
}

Result<ConcealedAnswer> answer_from_json(const ordered_json& json) {
  try {
    ConcealedAnswer answer;
    answer.generator = json.value("generator", answer.generator);
    answer.source = json.value("source", answer.source);
    answer.change = json.value("change", answer.change);
    const std::string rig = json.at("rig").get<std::string>();
    const auto found = data::find_bench_kind(rig);
    if (!found) return failure(ErrorCode::bad_data, fmt::format("unknown rig '{}'", rig));
    answer.rig = *found;
    for (std::size_t k = 0; k < json.at("effects").size(); ++k) {
      answer.effects.push_back(finding(json, k));
    }
    answer.disturbances = disturbances_in(json);
    answer.twins = json.at("twins").get<std::vector<std::string>>();
    answer.noise_std = number_or(json, "noise_std_nm", kNotComputed);
    answer.peak_torque = number_or(json, "tau_max", kNotComputed);
    answer.best_rmse = number_or(json, "best_rmse_nm", answer.noise_std);
    answer.at_output = number_or(json, "at_output", 1.0);
    answer.seed = json.value("seed", answer.seed);
    answer.dataset_sha256 = json.value("dataset_sha256", "");
    return answer;
  } catch (const nlohmann::json::exception& error) {
    return failure(ErrorCode::bad_data, fmt::format("the answer cannot be read: {}", error.what()),
                   "it has the keys of docs/trials.md");
  }
}

}  // namespace flexspline::studies
