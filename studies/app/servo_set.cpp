#include "servo_set.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "fitted_rig.hpp"
#include "flexspline/data/estimate_json.hpp"
#include "flexspline/estimators/servo_fit.hpp"

namespace flexspline::app {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view kStart = "start.";  // and the name of an unknown
constexpr double kMost = 1000.0;               // starts or searches, and the largest seed

Result<void> hold_out(RecordingSet& set, const std::vector<std::string>& ids) {
  for (Recording& one : set.recordings) one.split = Split::train;
  for (const std::string& id : ids) {
    const auto found = std::ranges::find(set.recordings, id, &Recording::id);
    if (found == set.recordings.end()) {
      return failure(ErrorCode::bad_data, fmt::format("there is no recording '{}' to hold out", id),
                     "flexspline validate DATASET lists them");
    }
    found->split = Split::holdout;
  }
  return {};
}

tl::unexpected<Error> no_option(const std::string& given) {
  return failure(ErrorCode::bad_data, fmt::format("a servo's fit has no option {}", given),
                 "it has duty=recorded or loop, loss=squared or absolute, zero=recorded or fitted, "
                 "arm=massless or rod, starts, searches and seed=1 to 1000, and "
                 "start.NAME=value, NAME an unknown");
}

/// Enters a word where it belongs. False: there is no such option.
bool enter(estimators::ServoSettings& settings, const std::string& option) {
  using namespace estimators;
  const std::map<std::string, std::function<void()>> known = {
      {"duty=recorded", [&] { settings.duty = ServoDuty::recorded; }},
      {"duty=loop", [&] { settings.duty = ServoDuty::loop; }},
      {"loss=squared", [&] { settings.loss = ServoLoss::squared; }},
      {"loss=absolute", [&] { settings.loss = ServoLoss::absolute; }},
      {"arm=massless", [&] { settings.arm = ServoArm::massless; }},
      {"arm=rod", [&] { settings.arm = ServoArm::rod; }},
      {"zero=recorded", [&] { settings.zero = ServoZero::recorded; }},
      {"zero=fitted", [&] { settings.zero = ServoZero::fitted; }}};
  const auto found = known.find(option);
  if (found != known.end()) found->second();
  return found != known.end();
}

/// Enters a number where it belongs. False: there is no such option, or not with that number.
bool enter(estimators::ServoSettings& settings, const std::string& option, double value) {
  if (option.starts_with(kStart)) {
    settings.start[option.substr(kStart.size())] = value;
    return true;
  }
  if (!(value >= 1.0 && value <= kMost)) return false;
  if (option == "starts") settings.starts = static_cast<int>(value);
  if (option == "searches") settings.searches = static_cast<int>(value);
  if (option == "seed") settings.seed = static_cast<std::uint64_t>(value);
  return option == "starts" || option == "searches" || option == "seed";
}

Result<estimators::ServoSettings> settings_of(const estimators::Options& options) {
  estimators::ServoSettings settings;
  for (const auto& [name, value] : options.words) {
    if (!enter(settings, name + "=" + value)) return no_option(name + "=" + value);
  }
  for (const auto& [name, value] : options.numbers) {
    if (!enter(settings, name, value)) return no_option(fmt::format("{}={:g}", name, value));
  }
  return settings;
}

/// Errors of the simulated angle over one recording, rad.
struct AngleError {
  double rms = kNotComputed;
  double mean = kNotComputed;  ///< of the magnitude
};

AngleError compared(const std::vector<double>& simulated, const std::vector<double>& measured) {
  double squares = 0.0;
  double magnitudes = 0.0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    squares += std::pow(simulated[i] - measured[i], 2);
    magnitudes += std::abs(simulated[i] - measured[i]);
  }
  const auto count = static_cast<double>(measured.size());
  return {std::sqrt(squares / count), magnitudes / count};
}

ordered_json number_or_null(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

/// The estimate with errors of every recording; one that cannot be simulated has null and says why.
ordered_json judged(const estimators::ServoFit& fit, const RecordingSet& set,
                    const estimators::ServoSettings& settings) {
  estimators::ServoFit known = fit;
  ordered_json errors[2] = {
      {{"train", ordered_json::object()}, {"holdout", ordered_json::object()}},
      {{"train", ordered_json::object()}, {"holdout", ordered_json::object()}}};
  for (const Recording& one : set.recordings) {
    const auto angle =
        estimators::simulate_servo(fit.drive, one, settings.tolerance, settings.duty);
    if (!angle) known.estimate.notes.push_back(angle.error().message());
    const AngleError error =
        angle ? compared(*angle, *one.find(Quantity::load_angle)) : AngleError{};
    const char* role = one.split == Split::holdout ? "holdout" : "train";
    errors[0][role][one.id] = number_or_null(error.rms);
    errors[1][role][one.id] = number_or_null(error.mean);
  }
  ordered_json estimate = data::to_json(known.estimate, {"rad", "Nm"});
  estimate["rmse"] = errors[0];
  estimate["mean_absolute_error"] = errors[1];
  estimate["error_unit"] = "rad";
  return estimate;
}

std::string summary_of(const ordered_json& estimate) {
  std::string text = fmt::format(
      "servo, angle simulated: {}, {} parameters, {}", estimate.value("termination", ""),
      estimate.at("parameters").size(), estimate.at("identifiability").value("says", ""));
  for (const char* role : {"train", "holdout"}) {
    for (const auto& [id, value] : estimate.at("rmse").at(role).items()) {
      const auto& mean = estimate.at("mean_absolute_error").at(role).at(id);
      text += value.is_null()
                  ? fmt::format("\n  {:<8} {:<28} not computed", role, id)
                  : fmt::format("\n  {:<8} {:<28} rmse {:.4g} rad, mean absolute error {:.4g} rad",
                                role, id, value.get<double>(), mean.get<double>());
    }
  }
  return text;
}

}  // namespace

Result<ExitCode> fit_servo_set(RecordingSet set, const estimators::GivenModel& model,
                               const std::optional<std::vector<std::string>>& held_out,
                               const estimators::Options& options,
                               const std::filesystem::path& folder, Console& console) {
  if (held_out) {
    if (auto held = hold_out(set, *held_out); !held) return tl::unexpected(held.error());
  }
  const auto settings = settings_of(options);
  if (!settings) return tl::unexpected(settings.error());
  const auto fit = estimators::fit_servo(set, model, *settings);
  if (!fit) return tl::unexpected(fit.error());
  ordered_json estimate = judged(*fit, set, *settings);
  const FittedRig rig = fitted_servo(set, fit->drive, estimate);
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (auto written = write_fit(folder, estimate, rig); !written) {
    return tl::unexpected(written.error());
  }
  console.result(console.json ? estimate.dump(2) : summary_of(estimate) + text_of(rig));
  return kDone;
}

}  // namespace flexspline::app
