#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "findings.hpp"
#include "json_fields.hpp"
#include "numbers.hpp"
#include "parse_artefacts.hpp"

namespace flexspline::reports {
namespace {

using nlohmann::json;

/// An element of a list, absent where the list is shorter.
double element(const std::vector<double>& list, std::size_t at) {
  return at < list.size() ? list[at] : kAbsent;
}

ShownMismatch parse_mismatch(const json& from) {
  const std::vector<double> interval = numbers_in(from, "interval_s");
  return {text_in(from, "recording"),
          text_in(from, "coordinate"),
          text_in(from, "equation"),
          text_in(from, "says"),
          element(interval, 0),
          element(interval, 1),
          number_in(from, "share_of_excess")};
}

ShownCauseParameter parse_parameter(const json& from) {
  ShownCauseParameter parameter;
  parameter.name = text_in(from, "name");
  parameter.unit = text_in(from, "unit");
  parameter.value = number_in(from, "value");
  parameter.std = number_in(from, "std");
  const std::vector<double> interval = numbers_in(from, "ci95");
  parameter.lower = element(interval, 0);
  parameter.upper = element(interval, 1);
  parameter.meaning = text_in(from, "meaning");
  parameter.no_interval = text_in(from, "no_interval");
  return parameter;
}

ShownCause parse_cause(const json& from) {
  ShownCause cause;
  cause.effect = text_in(from, "effect");
  cause.equation = text_in(from, "equation");
  cause.probability = number_in(from, "probability");
  cause.size_fraction = number_in(from, "size_fraction");
  cause.size = number_in(from, "size");
  const std::vector<double> sizes = numbers_in(from, "size_ci95");
  cause.size_lower = element(sizes, 0);
  cause.size_upper = element(sizes, 1);
  cause.unit = text_in(from, "unit");
  cause.size_of = text_in(from, "size_of");
  cause.alternatives = texts_in(from, "alternatives");
  for (const json& one : member(from, "parameters")) {
    cause.parameters.push_back(parse_parameter(one));
  }
  const json& evidence = member(from, "evidence");
  cause.p_value = number_in(evidence, "score_p_value");
  cause.holdout_ratio = number_in(evidence, "holdout_rmse_ratio");
  cause.delta_bic = number_in(evidence, "delta_bic");
  cause.ablation_ratio = number_in(evidence, "ablation_ratio");
  cause.placebo_ratio = number_in(evidence, "placebo_ratio");
  cause.stability = number_in(from, "stability");
  return cause;
}

ShownCandidate parse_candidate(const json& from) {
  const double round = number_in(from, "round");
  return {text_in(from, "effect"),
          text_in(from, "outcome"),
          std::isfinite(round) ? static_cast<int>(round) : 0,
          number_in(from, "misfit_removed"),
          number_in(from, "delta_bic"),
          number_in(from, "holdout_rmse_ratio")};
}

ShownMove parse_move(const json& from) {
  return {text_in(from, "name"), text_in(from, "unit"), number_in(from, "before"),
          number_in(from, "after"), number_in(from, "std")};
}

ShownSeries parse_series(const json& from) {
  return {text_in(from, "recording"),       text_in(from, "equation"),
          text_in(from, "role") == "train", numbers_in(from, "time"),
          numbers_in(from, "motion"),       numbers_in(from, "rate"),
          numbers_in(from, "measured"),     numbers_in(from, "before"),
          numbers_in(from, "after"),        numbers_in(from, "motor_angle")};
}

std::optional<ShownExperiment> parse_experiment(const json& from) {
  if (from.empty()) return std::nullopt;
  return ShownExperiment{texts_in(from, "separates"),     text_in(from, "excitation"),
                         text_in(from, "says"),           number_in(from, "amplitude"),
                         number_in(from, "frequency_hz"), number_in(from, "separation_sigma")};
}

/// None where the artefact has no table, or one that does not fit its axes.
std::optional<ShownUnnamed> parse_unnamed(const json& from) {
  const json& table = member(from, "table");
  ShownUnnamed part;
  std::size_t knots = 1;
  for (const json& axis : member(table, "axes")) {
    part.axes.push_back(
        {text_in(axis, "coordinate"), text_in(axis, "unit"), numbers_in(axis, "values")});
    knots *= part.axes.back().values.size();
  }
  part.torque = numbers_in(table, "torque");
  part.torque_unit = text_in(table, "unit");
  part.formula = text_in(from, "proposed_equation");
  part.says = text_in(from, "says");
  const bool fits = !part.axes.empty() && part.axes.size() <= 2 && part.torque.size() == knots;
  return fits ? std::optional(std::move(part)) : std::nullopt;
}

void parse_units(const json& from, DiagnosisView& into) {
  const auto take = [&](const char* key, std::string& unit) {
    if (const std::string text = text_in(from, key); !text.empty()) unit = text;
  };
  take("motion", into.units.motion);
  take("rate", into.units.rate);
  take("effort", into.units.effort);
  take("rmse", into.rmse_unit);
}

void parse_numbers(const json& artefact, DiagnosisView& into) {
  const json& baseline = member(artefact, "baseline");
  into.baseline = text_in(baseline, "model");
  into.rmse_train = number_in(member(baseline, "rmse_nm"), "train");
  into.rmse_holdout = number_in(member(baseline, "rmse_nm"), "holdout");
  into.noise = number_in(baseline, "noise_std_nm");
  const json& holdout = member(artefact, "holdout");
  into.before = number_in(holdout, "rmse_before_nm");
  into.after = number_in(holdout, "rmse_after_nm");
  into.ratio = number_in(holdout, "ratio");
  const std::vector<double> interval = numbers_in(holdout, "ci95");
  into.ratio_lower = element(interval, 0);
  into.ratio_upper = element(interval, 1);
  into.noise_floor = number_in(holdout, "noise_floor_nm");
  const json& nested = member(holdout, "nested");
  into.nested = nested.is_boolean() && nested.get<bool>();
  const double folds = number_in(holdout, "folds");
  into.folds = std::isfinite(folds) ? static_cast<int>(folds) : 0;
}

template <class Row, class Parse>
void parse_list(const json& artefact, const char* key, Parse parse, std::vector<Row>& into) {
  for (const json& one : member(artefact, key)) into.push_back(parse(one));
}

/// Ids of effects in a sentence as words, longest first where one is part of another.
void spell(const std::vector<std::string>& ids, std::string& text) {
  for (const std::string& id : ids) {
    for (std::size_t at = 0; (at = text.find(id, at)) != std::string::npos; at += id.size()) {
      text.replace(at, id.size(), words(id));
    }
  }
}

void spell_effects(DiagnosisView& view) {
  std::vector<std::string> ids;
  for (const ShownCandidate& one : view.tried) ids.push_back(one.effect);
  for (const ShownCause& one : view.causes) {
    ids.push_back(one.effect);
    ids.insert(ids.end(), one.alternatives.begin(), one.alternatives.end());
  }
  for (const ShownConfusable& one : view.confusable) ids.push_back(one.effect);
  if (view.next) ids.insert(ids.end(), view.next->separates.begin(), view.next->separates.end());
  std::erase_if(ids, [](const std::string& id) { return id.find('_') == std::string::npos; });
  std::sort(ids.begin(), ids.end(),
            [](const auto& a, const auto& b) { return a.size() > b.size(); });
  spell(ids, view.says);
  for (ShownMismatch& one : view.mismatch) spell(ids, one.says);
  for (ShownConfusable& one : view.confusable) spell(ids, one.why);
  for (ShownCandidate& one : view.tried) spell(ids, one.outcome);
  if (view.next) spell(ids, view.next->says);
}

}  // namespace

bool ShownSeries::has_after() const {
  return !after.empty() && !std::ranges::equal(before, after, [](double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
  });
}

bool ShownSeries::judged_everywhere() const {
  return std::ranges::none_of(before, [](double value) { return std::isnan(value); });
}

bool DiagnosisView::has_additions() const {
  return !causes.empty() || std::ranges::any_of(series, &ShownSeries::has_after);
}

bool DiagnosisView::has_equations() const {
  for (const ShownSeries& one : series) {
    if (one.equation != series.front().equation) return true;
  }
  return false;
}

std::string DiagnosisView::how_held_out() const {
  if (folds > 0) {
    return "on recordings that the whole search did not have (" + std::to_string(folds) +
           (folds == 1 ? " outer fold)" : " outer folds)");
  }
  return nested ? "on recordings taken away before the search"
                : "cross-validated, selection not nested,";
}

DiagnosisView parse_diagnosis(const json& artefact) {
  DiagnosisView view;
  view.dataset = text_in(member(artefact, "dataset"), "name");
  view.sha256 = text_in(member(artefact, "dataset"), "sha256");
  view.verdict = text_in(artefact, "verdict");
  view.says = text_in(artefact, "says");
  parse_numbers(artefact, view);
  parse_units(member(artefact, "units"), view);
  parse_list(artefact, "mismatch", parse_mismatch, view.mismatch);
  parse_list(artefact, "causes", parse_cause, view.causes);
  for (const json& one : member(artefact, "confusable")) {
    view.confusable.push_back({text_in(one, "effect"), text_in(one, "with"), text_in(one, "why"),
                               number_in(one, "similarity")});
  }
  parse_list(artefact, "tried", parse_candidate, view.tried);
  parse_list(artefact, "moved", parse_move, view.moved);
  view.unnamed = parse_unnamed(member(artefact, "unnamed"));
  view.next = parse_experiment(member(artefact, "next_experiment"));
  parse_list(artefact, "series", parse_series, view.series);
  // What moves the output is compared over its angle.
  const bool has_torsion = std::ranges::any_of(view.series, [](const ShownSeries& one) {
    return one.equation == "torsion" || one.motor_angle.empty();
  });
  if (!view.series.empty() && !has_torsion) view.units.angle = "joint angle";
  view.has_model = !member(artefact, "model").empty();
  for (const json& note : member(artefact, "notes")) {
    if (note.is_object() && note.contains("severity")) {
      view.findings.push_back(parse_finding(note));
      continue;
    }
    view.notes.push_back(note.is_string() ? note.get<std::string>() : text_in(note, "says"));
  }
  for (const auto& [name, version] : member(artefact, "versions").items()) {
    if (version.is_string()) view.versions[name] = version.get<std::string>();
  }
  spell_effects(view);
  return view;
}

}  // namespace flexspline::reports
