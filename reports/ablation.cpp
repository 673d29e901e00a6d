#include "ablation.hpp"

#include <algorithm>
#include <cmath>

#include <toml++/toml.h>

#include "numbers.hpp"

namespace flexspline::reports {
namespace {

double percent(const toml::table& bench, std::string_view key) {
  return 100.0 * bench[key].value<double>().value_or(kAbsent);
}

double error_of(const Case& item, const std::string& function) {
  const auto found = item.function_errors_percent.find(function);
  return found == item.function_errors_percent.end() ? kAbsent : found->second;
}

/// Median error on the held-out recordings that neither case would have to extrapolate to.
double common_error(const StudyView& view, const Input& input, const Case& of, const Case& other) {
  std::vector<double> errors;
  for (const CaseRecording* one : view.held_out(input, of)) {
    const CaseRecording* twin = other.recording(one->id);
    if (twin == nullptr || one->outside_domain || twin->outside_domain) continue;
    errors.push_back(one->error_percent());
  }
  return median(std::move(errors));
}

const Case* find_case(const StudyView& view, const Input& input, const std::string& estimator,
                      long replicate) {
  for (const Case& item : view.artefacts().cases) {
    const bool here = item.input == input.id && item.estimator == estimator;
    if (here && item.replicate == replicate && !item.failed) return &item;
  }
  return nullptr;
}

}  // namespace

AblationPlan parse_ablation(const std::string& lock) {
  AblationPlan plan;
  try {
    const toml::table table = toml::parse(lock);
    const auto rows = [&](const char* path, const auto& take) {
      const toml::array* list = table.at_path(path).as_array();
      if (list == nullptr) return;
      for (const toml::node& row : *list) {
        if (row.is_table()) take(*row.as_table());
      }
    };
    rows("study.contrast", [&](const toml::table& row) {
      const auto text = [&](const char* key) { return row[key].value_or(std::string()); };
      plan.contrasts.push_back({text("id"), text("title"), text("from"), text("to")});
    });
    rows("study.input", [&](const toml::table& row) {
      const toml::table* bench = row["bench"].as_table();
      if (bench == nullptr) return;
      plan.noise[row["id"].value_or(std::string())] = {percent(*bench, "angle_noise"),
                                                       percent(*bench, "torque_noise_white")};
    });
  } catch (const toml::parse_error&) {
    return {};
  }
  return plan;
}

std::vector<Gain> gains_of(const StudyView& view, const std::string& from, const std::string& to) {
  std::vector<Gain> gains;
  for (const Input& input : view.artefacts().inputs) {
    std::vector<double> g_inverse, torque;
    for (const Case& before : view.artefacts().cases) {
      if (before.input != input.id || before.estimator != from || before.failed) continue;
      const Case* after = find_case(view, input, to, before.replicate);
      if (after == nullptr) continue;
      g_inverse.push_back(error_of(before, "g_inverse") / error_of(*after, "g_inverse"));
      torque.push_back(common_error(view, input, before, *after) /
                       common_error(view, input, *after, before));
    }
    if (g_inverse.empty()) continue;
    gains.push_back({&input, median(std::move(g_inverse)), median(std::move(torque))});
  }
  return gains;
}

Spread3 spread_of(const std::vector<Gain>& gains, double Gain::*of) {
  std::vector<double> values;
  for (const Gain& gain : gains) {
    if (std::isfinite(gain.*of)) values.push_back(gain.*of);
  }
  if (values.empty()) return {};
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {*least, median(values), *most};
}

}  // namespace flexspline::reports
