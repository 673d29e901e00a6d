#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "comparison/decimate.hpp"
#include "comparison/function_errors.hpp"
#include "flexspline/core/signals.hpp"
#include "run/artefact_json.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

/// One steady cycle where there is one, else the whole recording.
std::vector<std::size_t> shown_samples(const TorsionRecord& record) {
  const auto smooth = reconstruct(record);
  if (!smooth || !smooth->steady) return kept_indices(0, record.time.size());
  const std::optional<SteadyPart>& steady = smooth->steady;
  // One sample more than a period, so that the loop closes.
  const double step = record.time[steady->last - 1] - record.time[steady->last - 2];
  const double start = record.time[steady->last - 1] - steady->period - 0.5 * step;
  const auto first = std::ranges::lower_bound(record.time, start) - record.time.begin();
  return kept_indices(std::max(steady->first, static_cast<std::size_t>(first)), steady->last);
}

double peak_of(const TorsionRecord& record) {
  double peak = 0.0;
  for (std::size_t i = 0; i < record.effort.size(); ++i) {
    if (i >= record.valid.size() || record.valid[i])
      peak = std::max(peak, std::abs(record.effort[i]));
  }
  return peak;
}

ordered_json recording_json(const StudyRecording& recording, const DisplayUnits& units) {
  const TorsionRecord& record = recording.record;
  const std::optional<LoopFigures> loop = loop_figures(record);
  const auto kept = shown_samples(record);
  return {{"id", record.id},
          {"role", record.split == Split::holdout ? "holdout" : "train"},
          {"amplitude", shown(amplitude_of(recording), units.motion)},
          {"frequency_hz", record.frequency_hz.value_or(kNotComputed)},
          {"samples", record.time.size()},
          {"peak_effort", shown(loop ? loop->peak_effort : peak_of(record), units.effort)},
          {"half_height", loop ? shown(loop->half_height, units.effort) : kNotComputed},
          {"loop_area", loop ? shown(shown(loop->area, units.effort), units.motion) : kNotComputed},
          {"time", at_indices(record.time, kept)},
          {"motion", shown(at_indices(record.motion, kept), units.motion)},
          {"effort", shown(at_indices(record.effort, kept), units.effort)}};
}

struct Curve {
  std::vector<double> argument;
  std::vector<double> value;
};

template <class Function>
Curve sample(double edge, const Function& function) {
  constexpr int kHalf = 60;
  Curve curve;
  for (int i = -kHalf; i <= kHalf; ++i) {
    curve.argument.push_back(edge * i / kHalf);
    curve.value.push_back(function(curve.argument.back()));
  }
  return curve;
}

ordered_json curve_json(const Curve& curve, const std::string& argument_unit,
                        const std::string& value_unit) {
  return {{"argument", shown(curve.argument, argument_unit)},
          {"value", value_unit.empty() ? curve.value : shown(curve.value, value_unit)}};
}

void add_truth(const PreparedInput& input, ordered_json& object) {
  if (!input.truth || !input.truth->slip_elements.empty()) return;
  std::vector<std::string> trained;
  for (const StudyRecording& recording : input.recordings) {
    if (recording.record.split == Split::train) trained.push_back(recording.record.id);
  }
  const Reach reach = reach_of(input, trained);
  const auto& log_h = input.truth->log_modulation;
  const auto h = [&](double phi) { return log_h ? std::exp(log_h(phi)) : 1.0; };
  const DisplayUnits& units = input.units;
  object["truth_functions"] = {
      {"f", curve_json(sample(reach.motion, input.truth->stiffness), units.motion, units.effort)},
      // A speed in motion units per second divides by the same factor as the motion.
      {"g_inverse",
       curve_json(sample(reach.speed, input.truth->damping), units.motion, units.effort)},
      {"h", curve_json(sample(reach.motion, h), units.motion, "")}};
}

}  // namespace

ordered_json input_json(const PreparedInput& input) {
  ordered_json object = {
      {"schema", kInputSchema},
      {"id", input.plan.input->id},
      {"title", input.plan.input->title},
      {"kind", input.truth ? "bench" : "dataset"},
      {"truth", input.truth ? ordered_json(input.plan.input->truth) : ordered_json(nullptr)},
      {"says", input.says},
      {"source", input.source},
      {"license", input.license},
      {"rig", name_of(input.rig)},
      {"replicate", input.plan.replicate},
      {"seed", input.plan.seed},
      {"depends_on", input.plan.depends_on},
      {"units",
       {{"motion", input.units.motion},
        {"rate", input.units.motion + "/s"},
        {"effort", input.units.effort}}},
      {"recordings", ordered_json::array()}};
  for (const StudyRecording& recording : input.recordings) {
    object["recordings"].push_back(recording_json(recording, input.units));
  }
  add_truth(input, object);
  return object;
}

}  // namespace flexspline::studies
