#include "diagnosis_summary.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "flexspline/studies/diagnosis_json.hpp"

namespace flexspline::app {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMostRows = 3;  // of each list: the page has them all

std::string number(const ordered_json& value, const char* format = "{:.3g}") {
  return value.is_number() ? fmt::format(fmt::runtime(format), value.get<double>()) : "-";
}

std::string parameter_text(const ordered_json& one) {
  std::string text = fmt::format("{} {}", one["name"].get<std::string>(), number(one["value"]));
  const auto unit = one["unit"].get<std::string>();
  if (unit != "1") text += " " + unit;
  if (one["ci95"].is_array()) {
    text += fmt::format(" ({} to {})", number(one["ci95"][0]), number(one["ci95"][1]));
  }
  return text;
}

std::string more_than(std::size_t count) {
  return count > kMostRows ? fmt::format(" and {} more", count - kMostRows) : "";
}

std::string parameters_line(const ordered_json& cause) {
  std::vector<std::string> texts;
  for (const auto& one : cause["parameters"]) texts.push_back(parameter_text(one));
  if (texts.empty()) return "";
  const std::string more = more_than(texts.size());
  texts.resize(std::min(texts.size(), kMostRows));
  return fmt::format("\n    {}{}", fmt::join(texts, ", "), more);
}

std::string share_of_folds(const ordered_json& stability) {
  return stability.is_number() ? fmt::format("{:.0f} %", 100.0 * stability.get<double>()) : "";
}

std::string cause_lines(const ordered_json& cause) {
  const std::string size =
      fmt::format("{} {}, {} %", number(cause["size"]), cause["unit"].get<std::string>(),
                  number(100.0 * cause["size_fraction"].get<double>(), "{:.2g}"));
  std::string text = fmt::format(
      "\n  {:<28} {:<18} {:<7} {:<9} {:<7}", cause["effect"].get<std::string>(), size,
      number(cause["probability"], "{:.2f}"), number(cause["evidence"]["holdout_rmse_ratio"]),
      share_of_folds(cause["stability"]));
  const auto others = cause["alternatives"].get<std::vector<std::string>>();
  if (!others.empty()) text += fmt::format(" or {}", fmt::join(others, " or "));
  return text + parameters_line(cause);
}

std::string causes_text(const ordered_json& json) {
  if (json["causes"].empty()) return "";
  std::string text =
      fmt::format("\n  {:<28} {:<18} {:<7} {:<9} {:<7}", "missing from the model, largest first",
                  "size, of the peak", "prob.", "hold-out", "folds");
  for (const auto& cause : json["causes"]) text += cause_lines(cause);
  return text;
}

std::string where_text(const ordered_json& json) {
  std::string text;
  const auto& list = json["mismatch"];
  for (std::size_t i = 0; i < std::min(list.size(), kMostRows); ++i) {
    text +=
        fmt::format("\n  where: {} ({}): {}", list[i]["coordinate"].get<std::string>(),
                    list[i]["recording"].get<std::string>(), list[i]["says"].get<std::string>());
  }
  return text;
}

std::string unnamed_text(const ordered_json& json) {
  return json.contains("unnamed") ? "\n  " + json["unnamed"]["says"].get<std::string>() : "";
}

std::string how_held_out(const ordered_json& holdout) {
  const int folds = holdout["folds"].get<int>();
  if (folds > 0) return fmt::format("{} outer fold{} of the search", folds, folds == 1 ? "" : "s");
  return holdout["nested"].get<bool>() ? "taken away before the search"
                                       : "cross-validated, selection not nested";
}

std::string held_out_line(const ordered_json& json) {
  const auto& h = json["holdout"];
  if (!h["rmse_before_nm"].is_number()) return "";
  const auto unit = json["units"]["rmse"].get<std::string>();
  return fmt::format("\n  held out: {} {} before, {} after; noise {} ({})",
                     number(h["rmse_before_nm"]), unit, number(h["rmse_after_nm"]),
                     number(h["noise_floor_nm"]), how_held_out(h));
}

std::string mistaken_text(const ordered_json& json) {
  std::string text;
  std::size_t count = 0;
  for (const auto& note : json["notes"]) {
    if (note["code"] == "remark" || ++count > kMostRows) continue;
    text += "\n  " + note["says"].get<std::string>();
  }
  return text + (count > kMostRows ? "\n " + more_than(count) : "");
}

}  // namespace

// From the artefact, so that units and words are those of the file.
std::string summary_of(const studies::Diagnosis& diagnosis) {
  const ordered_json json = studies::to_json(diagnosis);
  std::string text = fmt::format("{}: {}", name_of(diagnosis.verdict), diagnosis.says);
  text += causes_text(json) + where_text(json) + unnamed_text(json) + held_out_line(json) +
          mistaken_text(json);
  if (diagnosis.next_experiment) text += "\n  record next: " + diagnosis.next_experiment->says;
  return text;
}

}  // namespace flexspline::app
