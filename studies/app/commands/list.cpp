#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "flexspline/core/effect.hpp"
#include "flexspline/core/law.hpp"
#include "flexspline/core/nearest_name.hpp"
#include "flexspline/data/bench.hpp"
#include "flexspline/estimators/method.hpp"
#include "flexspline/studies/kind.hpp"
#include "flexspline/studies/metric.hpp"

namespace flexspline::app {
namespace {

using nlohmann::ordered_json;

ordered_json list_effects() {
  ordered_json list = ordered_json::array();
  for (const EffectRow& row : effects()) {
    ordered_json parameters = ordered_json::array();
    for (const EffectParameter& one : row.parameters) {
      parameters.push_back({{"name", one.name},
                            {"unit", one.unit},
                            {"lower", one.lower},
                            {"upper", one.upper},
                            {"nominal", one.nominal},
                            {"source", one.source}});
    }
    list.push_back({{"id", row.id},
                    {"says", row.equation},
                    {"coordinate", row.coordinate},
                    {"not_modelled", row.not_modelled},
                    {"parameters", parameters}});
  }
  return list;
}

ordered_json list_laws() {
  ordered_json list = ordered_json::array();
  for (const LawRow& row : laws()) {
    list.push_back(
        {{"id", row.id}, {"says", row.equation}, {"range", row.range}, {"source", row.source}});
  }
  return list;
}

ordered_json list_rigs() {
  ordered_json list = ordered_json::array();
  list.push_back({{"id", name_of(Rig::locked)},
                  {"says", "output locked, motor position-controlled: the paper's bench"}});
  list.push_back(
      {{"id", name_of(Rig::free)}, {"says", "inertial load on the output, both encoders"}});
  list.push_back({{"id", name_of(Rig::specimen)},
                  {"says", "anything whose force follows an imposed displacement"}});
  list.push_back({{"id", name_of(Rig::servo)},
                  {"says", "one encoder, no torque sensor; is read, has no torsion view"}});
  return list;
}

ordered_json list_estimators() {
  ordered_json list = ordered_json::array();
  for (const estimators::MethodRow& row : estimators::methods()) {
    ordered_json options = ordered_json::array();
    for (const estimators::OptionInfo& one : row.options) {
      ordered_json option = {{"name", one.name}, {"says", one.meaning}};
      if (one.choices.empty()) {
        option["default"] = one.value;
        option["from"] = one.lower;
        option["to"] = one.upper;
      } else {
        option["choices"] = one.choices;
      }
      options.push_back(option);
    }
    list.push_back(
        {{"id", row.id}, {"says", row.summary}, {"source", row.source}, {"options", options}});
  }
  return list;
}

ordered_json list_kinds() {
  ordered_json list = ordered_json::array();
  for (const studies::KindRow& row : studies::kinds()) {
    list.push_back({{"id", row.id}, {"says", row.summary}, {"cases", row.cases}});
  }
  return list;
}

ordered_json list_metrics() {
  ordered_json list = ordered_json::array();
  for (const studies::MetricRow& row : studies::metrics()) {
    const bool effort = row.unit == studies::MetricUnit::effort;
    list.push_back({{"id", row.id}, {"says", row.meaning}, {"unit", effort ? "effort" : "%"}});
  }
  return list;
}

ordered_json list_truths() {
  ordered_json list = ordered_json::array();
  for (const data::TruthRow& row : data::truths()) {
    list.push_back({{"id", row.id}, {"says", row.summary}, {"source", row.source}});
  }
  return list;
}

struct Catalogue {
  std::string_view name;
  ordered_json (*rows)();
};

constexpr Catalogue kCatalogues[] = {{"effects", list_effects}, {"laws", list_laws},
                                     {"rigs", list_rigs},       {"estimators", list_estimators},
                                     {"kinds", list_kinds},     {"metrics", list_metrics},
                                     {"truths", list_truths}};

std::string as_text(const ordered_json& rows) {
  std::string text;
  for (const ordered_json& row : rows) {
    text += fmt::format("{}{:<26} {}", text.empty() ? "" : "\n", row.at("id").get<std::string>(),
                        row.at("says").get<std::string>());
    for (const char* list : {"options", "parameters"}) {
      if (!row.contains(list)) continue;
      for (const ordered_json& one : row.at(list)) {
        text += fmt::format("\n    {:<24} {}", one.at("name").get<std::string>(),
                            one.contains("says") ? one.at("says").get<std::string>()
                                                 : one.at("unit").get<std::string>());
      }
    }
  }
  return text;
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const std::string name = arguments.text("catalogue");
  const auto found = std::ranges::find(kCatalogues, name, &Catalogue::name);
  if (found == std::end(kCatalogues)) {
    std::vector<std::string_view> names;
    for (const Catalogue& one : kCatalogues) names.push_back(one.name);
    return failure(ErrorCode::usage, fmt::format("there is no catalogue '{}'", name),
                   suggestion(name, names));
  }
  const ordered_json rows = found->rows();
  console.result(console.json ? rows.dump(2) : as_text(rows));
  return kDone;
}

}  // namespace

CommandRow describe_list() {
  return {.id = "list",
          .summary = "The catalogues: effects, laws, rigs, estimators, kinds, metrics, truths",
          .arguments = {{.name = "catalogue",
                         .meaning = "effects, laws, rigs, estimators, kinds, metrics or truths",
                         .value = "CATALOGUE",
                         .required = true}},
          .example = "flexspline list estimators",
          .run = run};
}

}  // namespace flexspline::app
