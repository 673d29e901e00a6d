#include <cmath>

#include <nlohmann/json.hpp>

#include "results/results_table.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

double number(const ordered_json& value) { return value.is_number() ? value.get<double>() : kNone; }

double error_of(const ordered_json& recording) {
  const double known = number(recording.at("rmse_true_percent_of_peak"));
  return std::isnan(known) ? number(recording.at("rmse_percent_of_peak")) : known;
}

}  // namespace

std::optional<CaseRow> row_of(const ordered_json& artefact) {
  if (artefact.value("status", "") != "done") return std::nullopt;
  CaseRow row;
  for (const ordered_json& parameter : artefact.at("estimate").at("parameters")) {
    row.parameters.push_back({parameter.at("name").get<std::string>(),
                              number(parameter.at("value")), number(parameter.at("std"))});
  }
  for (const ordered_json& recording : artefact.at("recordings")) {
    row.recordings.push_back({recording.at("id").get<std::string>(),
                              recording.at("role").get<std::string>(),
                              number(recording.at("amplitude")),
                              number(recording.at("frequency_hz")), error_of(recording)});
  }
  return row;
}

}  // namespace flexspline::studies
