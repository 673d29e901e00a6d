#include "error_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace flexspline::app {

using nlohmann::ordered_json;

std::string error_text(const ordered_json& rmse, const std::string& unit,
                       const ordered_json& percent_of_peak, bool outside_domain) {
  if (!rmse.is_number()) return "not computed";
  const std::string absolute = fmt::format("{:.4g} {}", rmse.get<double>(), unit);
  if (!percent_of_peak.is_number()) return absolute;
  const double percent = percent_of_peak.get<double>();
  if (outside_domain) {
    return fmt::format(
        "{}, {:.3g} % of the recording's peak: extrapolated, its motion or speed goes beyond what "
        "was trained on",
        absolute, percent);
  }
  if (percent > 100.0) {
    return fmt::format("{}, diverged: larger than the signal ({:.3g} % of the recording's peak)",
                       absolute, percent);
  }
  return fmt::format("{}, {:.3g} % of the recording's peak", absolute, percent);
}

std::string notes_text(const ordered_json& notes) {
  std::string text;
  for (const ordered_json& note : notes) {
    text += fmt::format("\n  note: {}", note.get<std::string>());
  }
  return text;
}

}  // namespace flexspline::app
