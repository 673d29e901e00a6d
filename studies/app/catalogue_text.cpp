#include "catalogue_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace flexspline::app {
namespace {

using nlohmann::ordered_json;

/// An option's meaning; a parameter's unit, bounds and nominal value.
std::string explained(const ordered_json& one) {
  if (one.contains("says")) return words(one.at("says"));
  return fmt::format("{}, {} to {}, nominal {} ({})", words(one.at("unit")), words(one.at("lower")),
                     words(one.at("upper")), words(one.at("nominal")), words(one.at("source")));
}

/// What an effect says beyond its equation and parameters.
std::string further_words(const ordered_json& row) {
  std::string text;
  if (!row.contains("enters")) return text;
  for (const char* key : {"enters", "coordinate", "rigs", "range", "not_modelled", "source",
                          "states", "passive", "rate_independent"}) {
    text += fmt::format("\n  {:<18} {}", key, words(row.at(key)));
  }
  if (!words(row.at("active_because")).empty()) {
    text += fmt::format("\n  {:<18} {}", "active because", words(row.at("active_because")));
  }
  return text;
}

std::string said(const ordered_json& one) {
  return fmt::format("\n    {:<24} {}, {}", words(one.at("name")), words(one.at("unit")),
                     words(one.at("says")));
}

/// A way in which a rig is simulated: what drives it and what it integrates.
std::string form_words(const ordered_json& form) {
  std::string text = fmt::format("\n  form {:<13} {}; driven by {}", words(form.at("id")),
                                 words(form.at("says")), words(form.at("inputs")));
  for (const ordered_json& one : form.at("states")) text += said(one);
  return text;
}

/// What a rig says beyond what it is.
std::string rig_words(const ordered_json& row) {
  std::string text;
  if (!row.contains("forms")) return text;
  for (const char* key : {"equations", "not_modelled", "outputs", "residuals"}) {
    text += fmt::format("\n  {:<18} {}", key, words(row.at(key)));
  }
  const ordered_json& channels = row.at("channels");
  text += fmt::format("\n  {:<18} {}", "recordings need", words(channels.at("needs")));
  text += fmt::format("\n  {:<18} {}", "and may have", words(channels.at("may_have")));
  for (const ordered_json& form : row.at("forms")) text += form_words(form);
  if (!row.at("constants").empty()) text += "\n  constants";
  for (const ordered_json& one : row.at("constants")) text += said(one);
  return text;
}

/// What a check may answer: code, severity and remedy.
std::string verdict_words(const ordered_json& row) {
  std::string text;
  if (!row.contains("verdicts")) return text;
  for (const ordered_json& one : row.at("verdicts")) {
    text += fmt::format("\n    {:<14} {:<8} {}", words(one.at("code")), words(one.at("severity")),
                        words(one.at("remedy")));
  }
  return text;
}

}  // namespace

std::string words(const ordered_json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const ordered_json& one : value) text += (text.empty() ? "" : ", ") + words(one);
  return text;
}

std::string catalogue_text(const ordered_json& rows) {
  std::string text;
  for (const ordered_json& row : rows) {
    text += fmt::format("{}{:<26} {}", text.empty() ? "" : "\n", row.at("id").get<std::string>(),
                        row.at("says").get<std::string>());
    text += further_words(row) + rig_words(row) + verdict_words(row);
    for (const char* list : {"options", "parameters", "arguments"}) {
      if (!row.contains(list)) continue;
      for (const ordered_json& one : row.at(list)) {
        text += fmt::format("\n    {:<24} {}", one.at("name").get<std::string>(), explained(one));
      }
    }
  }
  return text;
}

}  // namespace flexspline::app
