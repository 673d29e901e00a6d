#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "bench/hidden_measuring.hpp"
#include "bench/hidden_refusals.hpp"
#include "bench/hidden_size.hpp"
#include "flexspline/data/hidden_bench.hpp"

namespace flexspline::data {
namespace {

RecordingSet empty_set(const HiddenBench& bench) {
  const HiddenGear& gear = bench.gear;
  RecordingSet set;
  set.name = fmt::format("virtual-{}-{}", name_of(bench.kind()), bench.seed);
  set.rig = bench.rig;
  set.license = "CC0-1.0";
  set.source = "virtual bench";
  if (bench.rig != Rig::specimen || bench.travels) set.constants["gear_ratio"] = gear.gear_ratio;
  if (bench.rig != Rig::specimen) set.constants["motor_inertia_kgm2"] = gear.motor_inertia;
  if (bench.rig == Rig::free) set.constants["load_inertia_kgm2"] = gear.load_inertia;
  if (bench.rig == Rig::servo) {
    set.constants["load_mass_kg"] = gear.load_mass;
    set.constants["arm_length_m"] = gear.arm_length;
  }
  set.display = {"deg", "Nm"};
  return set;
}

std::optional<Error> not_finite(const HiddenSession& session, const HiddenSignals& s) {
  for (std::size_t k = 0; k < s.size(); ++k) {
    if (std::isfinite(s.torque[k] + s.motor_angle[k] + s.motor_torque[k])) continue;
    return Error{
        ErrorCode::numerics,
        fmt::format("recording {}: no finite torque at {} s", session.id, s.clock(k) - s.start_s),
        "choose an amplitude and a frequency that the gear's laws can follow",
        {}};
  }
  return std::nullopt;
}

std::optional<Error> not_finite(const std::vector<HiddenSession>& sessions,
                                const std::vector<HiddenSignals>& runs) {
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (auto error = not_finite(sessions[k], runs[k])) return error;
  }
  return std::nullopt;
}

HiddenFinding finding(const HiddenSizing& sizing, const HiddenScale& scale) {
  const HiddenRow& row = *sizing.amount.row;
  HiddenLaw law = row.make(scale, sizing.amount.amount);
  return {std::string(row.id),  std::string(row.coordinate), hidden_equation(row.site, scale.rig),
          sizing.size_fraction, std::move(law.parameters),   {row.names.begin(), row.names.end()},
          std::move(law.place)};
}

/// What a channel reads without a torque: the effect's offset, and what the bench's own zero is off
/// by.
void add_own_zeros(const HiddenNuisances& n, HiddenAnswer& answer) {
  for (HiddenFinding& found : answer.effects) {
    const HiddenSite site = (*find_hidden_effect(found.id))->site;
    double own = 0.0;
    if (site == HiddenSite::torque_sensor) own = n.torque_offset * answer.noise_std;
    if (site == HiddenSite::motor_sensor) own = n.motor_torque_offset * answer.motor_noise_std;
    for (HiddenParameter& one : found.parameters) {
      if (one.name == "offset") one.value += own;
    }
  }
}

void add_recordings(HiddenDataset& data, const HiddenBench& bench,
                    const std::vector<HiddenSession>& sessions,
                    const std::vector<HiddenSignals>& runs) {
  data.measured = empty_set(bench);
  data.ideal = empty_set(bench);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    data.ideal.recordings.push_back(
        ideal_recording(bench, sessions[k], filtered(runs[k], bench.nuisances.filter_samples)));
    data.measured.recordings.push_back(noisy_recording(
        bench, data.ideal.recordings.back(), data.answer.noise_std, data.answer.motor_noise_std));
  }
}

}  // namespace

Result<HiddenDataset> run_hidden_bench(const HiddenBench& bench,
                                       std::vector<HiddenEffect> effects) {
  if (auto error = refusal(bench)) return tl::unexpected(std::move(*error));
  if (auto error = refusal(bench, effects)) return tl::unexpected(std::move(*error));
  std::erase_if(effects, [](const HiddenEffect& effect) { return effect.size_fraction == 0.0; });
  std::ranges::sort(effects, {}, &HiddenEffect::id);
  const std::vector<HiddenSession> sessions = plan_sessions(bench);
  const std::vector<HiddenSignals> null_runs = run_sessions(bench, sessions, {}, {});
  if (auto error = not_finite(sessions, null_runs)) return tl::unexpected(std::move(*error));
  const HiddenScale scale = measure_scale(bench, sessions, null_runs);
  HiddenDataset data;
  std::vector<HiddenAmount> amounts;
  for (const HiddenEffect& effect : effects) {
    auto sizing = size_effect(bench, sessions, null_runs, scale, **find_hidden_effect(effect.id),
                              effect.size_fraction);
    if (!sizing) return tl::unexpected(sizing.error());
    amounts.push_back(sizing->amount);
    data.answer.effects.push_back(finding(*sizing, scale));
  }
  data.answer.peak_torque = scale.torque;
  data.answer.peak_motor_torque = scale.motor_torque;
  data.answer.noise_std = bench.nuisances.torque_noise * scale.torque;
  data.answer.motor_noise_std = bench.nuisances.torque_noise * scale.motor_torque;
  add_own_zeros(bench.nuisances, data.answer);
  const std::vector<HiddenSignals> runs = run_sessions(bench, sessions, scale, amounts);
  if (auto error = not_finite(sessions, runs)) return tl::unexpected(std::move(*error));
  add_recordings(data, bench, sessions, runs);
  return data;
}

}  // namespace flexspline::data
