#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "dataset_study.hpp"
#include "flexspline/core/units.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/studies/diagnosis.hpp"
#include "flexspline/studies/next_loops.hpp"

namespace flexspline::app {
namespace {

using nlohmann::ordered_json;
using studies::LoopPlan;
using studies::LoopProspect;

constexpr double kOfDiagnosis = 0.4;  // of the time
constexpr std::size_t kShown = 6;

double shown_motion(const RecordingSet& set, double si) {
  const auto unit = find_unit(set.display.motion);
  return unit ? from_si(*unit, si) : si;
}

std::string band_text(const LoopProspect& one) {
  if (!one.tells_h) return "h is not identifiable";
  if (std::isnan(one.h_half_width)) return "h is identifiable";
  return fmt::format("h to +-{:.2g} %", 100.0 * std::expm1(one.h_half_width));
}

std::string loop_text(const RecordingSet& set, const LoopProspect& one) {
  return fmt::format("{:.3g} {}, {:.3g} Hz", shown_motion(set, one.amplitude), set.display.motion,
                     one.frequency_hz);
}

std::string causes_text(const RecordingSet& set, const studies::Diagnosis& diagnosis) {
  std::string text = fmt::format("causes: {}", diagnosis.says);
  for (const studies::NextExperiment& next : diagnosis.experiments) {
    text += fmt::format("\n  record next: {}; amplitude {:.3g} {}", next.says,
                        shown_motion(set, next.amplitude), set.display.motion);
  }
  if (!diagnosis.experiments.empty()) return text;
  return text + "\n  no recording is proposed: no two causes are left to separate";
}

/// Absent, with the reason, where the rig has no loops of torsion to plan.
std::string loops_text(const RecordingSet& set, const Result<LoopPlan>& planned) {
  if (!planned) return fmt::format("\nloops that identify h: {}", planned.error().message());
  const LoopPlan& plan = *planned;
  std::string text = fmt::format("\nh in these recordings: {}\n  {:<37} {}", plan.says,
                                 "expected of these motions", band_text(plan.recorded));
  for (std::size_t i = 0; i < std::min(kShown, plan.candidates.size()); ++i) {
    text += fmt::format("\n  with a sine of {:<22} {}", loop_text(set, plan.candidates[i]),
                        band_text(plan.candidates[i]));
  }
  return text + fmt::format(
                    "\nexpected, if the gear is like its fit and leaves {:.2g} of noise (SI); "
                    "three cycles of 200 samples",
                    plan.torque_noise);
}

ordered_json number_or_null(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json json_of(const LoopProspect& one) {
  return {{"amplitude", one.amplitude},
          {"frequency_hz", one.frequency_hz},
          {"h_identifiable", one.tells_h},
          {"log_h_half_width", number_or_null(one.h_half_width)}};
}

ordered_json json_of(const studies::NextExperiment& next) {
  return {{"separates", next.separates},
          {"excitation", next.excitation},
          {"amplitude", number_or_null(next.amplitude)},
          {"frequency_hz", number_or_null(next.frequency_hz)},
          {"separation_sigma", number_or_null(next.separation_sigma)},
          {"says", next.says}};
}

ordered_json json_of(const Result<LoopPlan>& planned, const studies::Diagnosis& diagnosis) {
  ordered_json experiments = ordered_json::array();
  for (const auto& next : diagnosis.experiments) experiments.push_back(json_of(next));
  ordered_json list = ordered_json::array();
  for (std::size_t i = 0; planned && i < planned->candidates.size(); ++i) {
    list.push_back(json_of(planned->candidates[i]));
  }
  return {{"causes", experiments.empty() ? ordered_json(nullptr) : experiments.front()},
          {"experiments", experiments},
          {"recorded", planned ? json_of(planned->recorded) : ordered_json(nullptr)},
          {"torque_noise", planned ? number_or_null(planned->torque_noise) : ordered_json(nullptr)},
          {"candidates", list},
          {"loops_not_planned",
           planned ? ordered_json(nullptr) : ordered_json(planned.error().message())}};
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto rows = rows_of(arguments);
  if (!rows) return tl::unexpected(rows.error());
  const auto set = data::load_dataset(arguments.text("dataset"), *rows);
  if (!set) return tl::unexpected(set.error());
  for (const std::string& note : set->notes) console.say(note);
  const auto diagnosis = studies::diagnose(
      *set,
      [&](double share, std::string_view stage) { console.progress(kOfDiagnosis * share, stage); },
      {.nested = false});
  if (!diagnosis) return tl::unexpected(in_context(diagnosis.error(), "diagnosis"));
  const auto plan = studies::plan_loops(*set, [&](double share) {
    console.progress(kOfDiagnosis + (1.0 - kOfDiagnosis) * share, "fitting with one loop more");
  });
  if (!plan && plan.error().code != ErrorCode::bad_data) return tl::unexpected(plan.error());
  console.result(console.json ? json_of(plan, *diagnosis).dump(2)
                              : causes_text(*set, *diagnosis) + loops_text(*set, plan));
  return kDone;
}

}  // namespace

CommandRow describe_plan_experiment() {
  return {
      .id = "plan-experiment",
      .group = "Fit and diagnose",
      .summary =
          "Which recording to take next, on any rig: to separate causes that cannot be decided, "
          "and to identify h where a torsion is imposed; writes nothing",
      .arguments = {{.name = "dataset",
                     .meaning = "folder of a data set",
                     .value = "DATASET",
                     .required = true},
                    rows_argument()},
      .example = "flexspline plan-experiment docs/examples/locked-gear",
      .run = run};
}

}  // namespace flexspline::app
