#include "fitted_rig.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "error_text.hpp"
#include "flexspline/core/rig.hpp"
#include "flexspline/core/simulate_rig.hpp"
#include "flexspline/data/artefact.hpp"
#include "flexspline/data/estimate_json.hpp"
#include "flexspline/data/model_toml.hpp"
#include "flexspline/estimators/rig_fit.hpp"

namespace flexspline::app {
namespace {

using nlohmann::ordered_json;

/// Whether every interval of these parameters holds zero.
bool holds_zero(const ordered_json& parameter) {
  const auto& interval = parameter.at("ci95");
  return interval[0].is_number() && interval[0].get<double>() <= 0.0 &&
         interval[1].get<double>() >= 0.0;
}

std::vector<ordered_json> parameters_of(const ordered_json& estimate, std::string_view law) {
  std::vector<ordered_json> list;
  for (const auto& one : estimate.at("parameters")) {
    if (one.at("name").get<std::string>().starts_with(law)) list.push_back(one);
  }
  return list;
}

Origin origin_of_h(const LawSpec& h, const ordered_json& estimate) {
  const bool lost = estimate.at("identifiability").value("verdict", "") == "not_identifiable";
  auto fitted = parameters_of(estimate, "ln_h[");
  if (fitted.empty()) fitted = parameters_of(estimate, "h[");
  if (fitted.empty()) {
    if (!h.coefficients.empty()) return Origin::given;
    return lost ? Origin::not_identifiable : Origin::assumed;
  }
  return lost || std::ranges::all_of(fitted, holds_zero) ? Origin::not_identifiable
                                                         : Origin::fitted;
}

/// Only a model file can have laws that stay.
void mark_laws(const ordered_json& estimate, RigModel& model) {
  const bool form = estimate.value("estimator", "") == "model_file";
  for (const char* law : {"f", "g_inverse"}) {
    const bool stays = form && parameters_of(estimate, fmt::format("{}[", law)).empty();
    model.origin[law] = stays ? Origin::given : Origin::fitted;
  }
  model.origin["h"] = origin_of_h(model.drive.torsion.h, estimate);
}

/// The weight is an effect, whose phase is the zero of the angle.
void mark_servo(const RecordingSet& set, const ordered_json& estimate, RigModel& model) {
  model.origin["gear_ratio"] =
      set.constants.contains("gear_ratio") ? Origin::given : Origin::assumed;
  for (const DriveConstant& one : rig_row(Rig::servo).constants) {
    if (model.drive.*one.member == 0.0 || one.name == "coulomb_width") continue;
    const auto fitted =
        parameters_of(estimate, one.name == "back_emf" ? "torque_constant" : one.name);
    const bool lost = !fitted.empty() && holds_zero(fitted.front());
    model.origin.emplace(one.name, fitted.empty() ? Origin::given
                                   : lost         ? Origin::not_identifiable
                                                  : Origin::fitted);
  }
  model.drive.torsion.effects.back().note = "the weight stated; phase: the zero of the angle";
}

/// Rms of the motor's torque along each recording, as the model file has it.
Result<ordered_json> motor_errors(const RigModel& model, const RecordingSet& set) {
  ordered_json errors = {{"train", ordered_json::object()}, {"holdout", ordered_json::object()}};
  for (const Recording& one : set.recordings) {
    const auto* measured = one.find(Quantity::motor_torque);
    if (measured == nullptr || model.rig == Rig::specimen) continue;
    const auto predicted = torques_along(model, one);
    if (!predicted) return tl::unexpected(in_context(predicted.error(), one.id));
    const auto* simulated = predicted->find(Quantity::motor_torque);
    double squares = 0.0;
    double peak = 0.0;
    for (std::size_t i = 0; i < measured->size(); ++i) {
      squares += std::pow((*simulated)[i] - (*measured)[i], 2);
      peak = std::max(peak, std::abs((*measured)[i]));
    }
    const double rms = std::sqrt(squares / static_cast<double>(measured->size()));
    errors[one.split == Split::holdout ? "holdout" : "train"][one.id] = {
        {"rmse", rms}, {"percent_of_peak", 100.0 * rms / peak}};
  }
  return errors;
}

/// What cannot be simulated along the recordings is not judged, and says so: the fit stands.
FittedRig judged(const RecordingSet& set, RigModel model,
                 const std::vector<ParameterEstimate>& constants, std::vector<std::string> notes) {
  auto corrections = estimators::judge_corrections(set, model);
  if (corrections) {
    model = std::move(corrections->model);
    notes.insert(notes.end(), corrections->notes.begin(), corrections->notes.end());
  } else {
    notes.push_back("sizes of the corrections not judged: " + corrections.error().message());
  }
  ordered_json errors = {{"train", ordered_json::object()}, {"holdout", ordered_json::object()}};
  if (auto computed = motor_errors(model, set)) {
    errors = std::move(*computed);
  } else {
    notes.push_back("motor torque not simulated: " + computed.error().message());
  }
  ordered_json origin = ordered_json::object();
  for (const auto& [name, one] : model.origin) origin[name] = name_of(one);
  return {std::move(model),
          {{"origin", std::move(origin)},
           {"parameters", data::to_json(constants)},
           {"motor_torque_error", std::move(errors)},
           {"notes", std::move(notes)}}};
}

std::string constant_line(const ordered_json& one, const ordered_json& origin) {
  const std::string name = one.at("name").get<std::string>();
  const std::string std = one.at("std").is_number()
                              ? fmt::format(" +- {:.2g}", 1.96 * one.at("std").get<double>())
                              : std::string();
  return fmt::format("\n  rig      {:<28} {:.4g}{} {} ({})", name, one.at("value").get<double>(),
                     std, one.value("unit", ""), origin.at(name).get<std::string>());
}

}  // namespace

Result<FittedRig> fitted_rig(const RecordingSet& set, const ordered_json& estimate) {
  const auto torsion = data::model_from_json(estimate.at("model"));
  if (!torsion) return tl::unexpected(torsion.error());
  auto fit = estimators::complete_rig(set, *torsion);
  if (!fit) return tl::unexpected(fit.error());
  mark_laws(estimate, fit->model);
  return judged(set, fit->model, fit->parameters, std::move(fit->notes));
}

FittedRig fitted_servo(const RecordingSet& set, const DriveSpec& drive,
                       const ordered_json& estimate) {
  RigModel model{Rig::servo, drive};
  mark_servo(set, estimate, model);
  return judged(set, model, {}, {});
}

Result<void> write_fit(const std::filesystem::path& folder, ordered_json& estimate,
                       const FittedRig& rig) {
  estimate["rig"] = rig.says;
  if (auto written = data::write_model(folder / "model.toml", rig.model); !written) return written;
  return data::write_artefact(folder / "estimate.json", estimate);
}

std::string text_of(const FittedRig& rig) {
  std::string text;
  for (const auto& one : rig.says.at("parameters")) {
    text += constant_line(one, rig.says.at("origin"));
  }
  for (const char* role : {"train", "holdout"}) {
    for (const auto& [id, error] : rig.says.at("motor_torque_error").at(role).items()) {
      text += fmt::format(
          "\n  {:<8} {:<28} motor torque, whole rig: rmse {:.4g} Nm, {:.3g} % of "
          "the recording's peak",
          role, id, error.at("rmse").get<double>(), error.at("percent_of_peak").get<double>());
    }
  }
  return text + notes_text(rig.says.at("notes"));
}

}  // namespace flexspline::app
