#include "dataset_summary.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "flexspline/core/signals.hpp"
#include "flexspline/data/dataset.hpp"

namespace flexspline::app {
namespace {

using nlohmann::ordered_json;
using Series = std::vector<double>;

constexpr std::size_t kMostSamples = 20000;  // of a recording whose frequency is looked for

ordered_json optional_number(const std::optional<double>& value, double factor = 1.0) {
  return value ? ordered_json(*value / factor) : ordered_json(nullptr);
}

bool is_valid(const Recording& recording, std::size_t i) {
  const Series* marks = recording.find(Quantity::valid);
  return marks == nullptr || (*marks)[i] >= 0.5;
}

bool is_effort(const Unit& unit) {
  return unit.dimension == Dimension::torque || unit.dimension == Dimension::force;
}

/// Over the samples that count.
ordered_json channel_of(const Recording& recording, Quantity quantity, const Series& values,
                        const DisplayUnits& display) {
  const Unit unit = data::display_unit(quantity, display);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!is_valid(recording, i)) continue;
    low = std::min(low, values[i]);
    high = std::max(high, values[i]);
  }
  ordered_json channel = {{"quantity", name_of(quantity)},
                          {"unit", unit.symbol},
                          {"least", from_si(unit, low)},
                          {"greatest", from_si(unit, high)}};
  if (is_effort(unit)) {
    channel["peak"] = std::max(std::abs(from_si(unit, low)), std::abs(from_si(unit, high)));
  }
  return channel;
}

/// The motion that a nominal amplitude is of, at the output.
std::optional<std::pair<Quantity, double>> excited(const RecordingSet& set,
                                                   const Recording& recording) {
  if (set.rig == Rig::locked) {
    return std::pair(Quantity::motor_angle, 1.0 / set.constants.at("gear_ratio"));
  }
  for (const Quantity quantity :
       {Quantity::load_angle, Quantity::torsion, Quantity::displacement, Quantity::angle}) {
    if (recording.find(quantity) != nullptr) return std::pair(quantity, 1.0);
  }
  return std::nullopt;
}

/// The strongest sine of the motion.
ordered_json measured_excitation(const RecordingSet& set, const Recording& recording) {
  const auto motion = excited(set, recording);
  if (!motion) return nullptr;
  const auto& [quantity, gain] = *motion;
  const Series& values = *recording.find(quantity);
  Series time;
  Series signal;
  const std::size_t stride = (values.size() + kMostSamples - 1) / kMostSamples;
  for (std::size_t i = 0; i < values.size(); i += stride) {
    time.push_back(recording.time[i]);
    signal.push_back(gain * values[i]);
  }
  const SineFit sine = fit_sine(time, signal, std::nullopt);
  const auto [low, high] = std::ranges::minmax(signal);
  const double unit = data::display_unit(quantity, set.display).factor;
  return {{"of", name_of(quantity)},
          {"frequency_hz", sine.frequency_hz},
          {"amplitude", sine.amplitude / unit},
          {"half_range", 0.5 * (high - low) / unit},
          {"explained_by_sine", sine.explained}};
}

ordered_json recording_of(const RecordingSet& set, const Recording& recording) {
  const std::size_t rows = recording.time.size();
  std::size_t valid = 0;
  for (std::size_t i = 0; i < rows; ++i) valid += is_valid(recording, i) ? 1 : 0;
  const double duration = recording.time.back() - recording.time.front();
  ordered_json channels = ordered_json::array();
  for (const auto& [quantity, values] : recording.channels) {
    if (quantity == Quantity::valid) continue;
    channels.push_back(channel_of(recording, quantity, values, set.display));
  }
  const auto motion = excited(set, recording);
  const Unit unit = data::display_unit(motion ? motion->first : Quantity::load_angle, set.display);
  const char* split = recording.split == Split::train     ? "train"
                      : recording.split == Split::holdout ? "holdout"
                                                          : "not stated";
  return {{"id", recording.id},
          {"rows", rows},
          {"valid", valid},
          {"rate_hz", static_cast<double>(rows - 1) / duration},
          {"duration_s", duration},
          {"start_s", recording.start_s},
          {"split", split},
          {"channels", channels},
          {"excitation",
           {{"unit", unit.symbol},
            {"stated",
             {{"kind", recording.excitation},
              {"amplitude", optional_number(recording.amplitude, unit.factor)},
              {"frequency_hz", optional_number(recording.frequency_hz)}}},
            {"measured", measured_excitation(set, recording)}}}};
}

std::string stated_text(const ordered_json& stated, const std::string& unit) {
  std::string text = stated.at("kind").get<std::string>();
  if (text.empty()) text = "nothing";
  if (!stated.at("amplitude").is_null()) {
    text += fmt::format(", {:.4g} {}", stated.at("amplitude").get<double>(), unit);
  }
  if (!stated.at("frequency_hz").is_null()) {
    text += fmt::format(", {:.4g} Hz", stated.at("frequency_hz").get<double>());
  }
  return text;
}

std::string measured_text(const ordered_json& measured, const std::string& unit) {
  if (measured.is_null()) return "no motion is recorded";
  return fmt::format(
      "half range {0:.4g} {3}; strongest sine {1:.4g} {3} at {2:.4g} Hz, {4:.3g} % "
      "of the variance",
      measured.at("half_range").get<double>(), measured.at("amplitude").get<double>(),
      measured.at("frequency_hz").get<double>(), unit,
      100.0 * measured.at("explained_by_sine").get<double>());
}

std::string recording_text(const ordered_json& one) {
  const auto rows = one.at("rows").get<std::size_t>();
  const auto valid = one.at("valid").get<std::size_t>();
  std::string text =
      fmt::format("\n  {}: {} rows{}, {:.4g} Hz, {:.4g} s from {:.6g} s, split {}",
                  one.at("id").get<std::string>(), rows,
                  valid == rows ? std::string() : fmt::format(" ({} valid)", valid),
                  one.at("rate_hz").get<double>(), one.at("duration_s").get<double>(),
                  one.at("start_s").get<double>(), one.at("split").get<std::string>());
  for (const ordered_json& channel : one.at("channels")) {
    const std::string unit = channel.at("unit").get<std::string>();
    text +=
        fmt::format("\n    {:<20} {:.4g} to {:.4g} {}", channel.at("quantity").get<std::string>(),
                    channel.at("least").get<double>(), channel.at("greatest").get<double>(), unit);
    if (channel.contains("peak")) {
      text += fmt::format(", peak {:.4g} {}", channel.at("peak").get<double>(), unit);
    }
  }
  const ordered_json& excitation = one.at("excitation");
  const std::string unit = excitation.at("unit").get<std::string>();
  text += fmt::format("\n    {:<20} {}\n    {:<20} {}", "excitation stated",
                      stated_text(excitation.at("stated"), unit), "measured",
                      measured_text(excitation.at("measured"), unit));
  return text;
}

}  // namespace

ordered_json dataset_summary(const RecordingSet& set) {
  ordered_json recordings = ordered_json::array();
  for (const Recording& one : set.recordings) recordings.push_back(recording_of(set, one));
  return {{"name", set.name},        {"rig", name_of(set.rig)}, {"license", set.license},
          {"source", set.source},    {"sha256", set.sha256},    {"constants", set.constants},
          {"recordings", recordings}};
}

std::string summary_text(const ordered_json& summary) {
  std::string text =
      fmt::format("{}: {} rig, {} recordings", summary.at("name").get<std::string>(),
                  summary.at("rig").get<std::string>(), summary.at("recordings").size());
  for (const auto& [name, value] : summary.at("constants").items()) {
    text += fmt::format("\n  {:<22} {:.6g}", name, value.get<double>());
  }
  for (const ordered_json& one : summary.at("recordings")) text += recording_text(one);
  return text;
}

}  // namespace flexspline::app
