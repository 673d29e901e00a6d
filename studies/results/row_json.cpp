#include "results/row_json.hpp"

#include <limits>

#include <nlohmann/json.hpp>

namespace flexspline::studies {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

double number_of(const json& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

CaseRow read(const json& from) {
  CaseRow row;
  row.linear = from.at("linear");
  for (const json& one : from.at("parameters")) {
    row.parameters.push_back({one.at(0), number_of(one.at(1)), number_of(one.at(2)), one.at(3)});
  }
  for (const json& one : from.at("recordings")) {
    row.recordings.push_back({one.at(0), one.at(1), number_of(one.at(2)), number_of(one.at(3)),
                              number_of(one.at(4)), number_of(one.at(5)), one.at(6)});
  }
  for (const auto& [name, value] : from.at("numbers").items()) row.numbers[name] = number_of(value);
  for (const auto& [name, list] : from.at("lists").items()) {
    for (const json& value : list) row.lists[name].push_back(number_of(value));
  }
  return row;
}

}  // namespace

double CaseRow::number(const std::string& name) const {
  const auto found = numbers.find(name);
  return found == numbers.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
}

ordered_json row_json(const CaseRow& row) {
  ordered_json parameters = ordered_json::array();
  for (const CaseRow::Parameter& one : row.parameters) {
    parameters.push_back(ordered_json::array({one.name, one.value, one.std, one.unit}));
  }
  ordered_json recordings = ordered_json::array();
  for (const CaseRow::Recording& one : row.recordings) {
    recordings.push_back(ordered_json::array({one.id, one.role, one.amplitude, one.frequency_hz,
                                              one.error_percent, one.error, one.outside_domain}));
  }
  return {{"linear", row.linear},
          {"parameters", std::move(parameters)},
          {"recordings", std::move(recordings)},
          {"numbers", row.numbers},
          {"lists", row.lists}};
}

Result<CaseRow> row_from_json(std::string_view text) {
  try {
    return read(json::parse(text));
  } catch (const json::exception& error) {
    return failure(ErrorCode::bad_data, std::string("a case's row cannot be read: ") + error.what(),
                   "run the study again with this version");
  }
}

}  // namespace flexspline::studies
