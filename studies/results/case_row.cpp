#include <cmath>

#include <nlohmann/json.hpp>

#include "flexspline/core/units.hpp"
#include "results/results_table.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

double number(const ordered_json& value) { return value.is_number() ? value.get<double>() : kNone; }

double known_or(const ordered_json& recording, const char* known, const char* otherwise) {
  const double value = number(recording.at(known));
  return std::isnan(value) ? number(recording.at(otherwise)) : value;
}

}  // namespace

std::optional<CaseRow> row_of(const ordered_json& artefact) {
  if (artefact.value("status", "") != "done") return std::nullopt;
  CaseRow row;
  const auto effort = find_unit(artefact.at("units").at("effort").get<std::string>());
  row.linear = effort && effort->dimension == Dimension::force;
  for (const ordered_json& parameter : artefact.at("estimate").at("parameters")) {
    row.parameters.push_back({parameter.at("name").get<std::string>(),
                              number(parameter.at("value")), number(parameter.at("std")),
                              parameter.at("unit").get<std::string>()});
  }
  for (const ordered_json& recording : artefact.at("recordings")) {
    row.recordings.push_back(
        {recording.at("id").get<std::string>(), recording.at("role").get<std::string>(),
         number(recording.at("amplitude")), number(recording.at("frequency_hz")),
         known_or(recording, "rmse_true_percent_of_peak", "rmse_percent_of_peak"),
         (effort ? effort->factor : kNone) * known_or(recording, "rmse_true", "rmse")});
  }
  return row;
}

}  // namespace flexspline::studies
