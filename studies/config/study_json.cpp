#include "config/study_json.hpp"

#include <nlohmann/json.hpp>

#include "flexspline/data/estimate_json.hpp"

namespace flexspline::studies {

using nlohmann::ordered_json;

ordered_json to_json(const BenchConfig& bench) {
  return {{"encoder_step_rad", bench.sensors.encoder_step},
          {"angle_noise", bench.sensors.angle_noise},
          {"torque_noise_white", bench.sensors.torque_noise_white},
          {"torque_noise_coloured", bench.sensors.torque_noise_coloured},
          {"torque_noise_samples", bench.sensors.torque_noise_samples},
          {"time_jitter", bench.sensors.time_jitter},
          {"missing_samples", bench.sensors.missing_samples},
          {"cycles", bench.cycles},
          {"samples_per_cycle", bench.samples_per_cycle}};
}

ordered_json to_json(const std::vector<Loop>& loops) {
  ordered_json list = ordered_json::array();
  for (const Loop& loop : loops) {
    ordered_json pair = ordered_json::array();
    pair.push_back(loop.amplitude);
    pair.push_back(loop.frequency_hz);
    list.push_back(std::move(pair));
  }
  return list;
}

ordered_json to_json(const estimators::Options& options) {
  ordered_json object = ordered_json::object();
  for (const auto& [name, value] : options.numbers) object[name] = value;
  for (const auto& [name, value] : options.words) object[name] = value;
  return object;
}

ordered_json to_json(const estimators::GivenModel& given) {
  return {{"starts", data::to_json(given.model)}, {"hold", given.hold}, {"free", given.free}};
}

ordered_json to_json(const StudyConfig& study) {
  ordered_json object = {
      {"name", study.name},           {"title", study.title},           {"kind", study.kind},
      {"seed", study.seed},           {"replicates", study.replicates}, {"paper", study.paper},
      {"bench", to_json(study.bench)}};
  ordered_json& grids = object["grid"] = ordered_json::array();
  for (const Grid& grid : study.grids) {
    grids.push_back({{"id", grid.id}, {"loops_rad_hz", to_json(grid.loops)}});
  }
  ordered_json& inputs = object["input"] = ordered_json::array();
  for (const InputConfig& input : study.inputs) {
    inputs.push_back({{"id", input.id},
                      {"title", input.title},
                      {"truth", input.truth},
                      {"dataset", input.dataset.generic_string()},
                      {"holdout", input.holdout}});
    if (input.bench) inputs.back()["bench"] = to_json(*input.bench);
    if (!input.strength.empty()) inputs.back()["strength"] = input.strength;
    if (input.held_out) inputs.back()["held_out"] = *input.held_out;
    if (input.rows != data::kMostRows) inputs.back()["rows"] = input.rows;
  }
  ordered_json& rows = object["estimator"] = ordered_json::array();
  for (const EstimatorConfig& row : study.estimators) {
    rows.push_back({{"id", row.id},
                    {"title", row.title},
                    {"method", row.method},
                    {"train", row.train},
                    {"steady", row.steady},
                    {"options", to_json(row.options)},
                    {"inputs", row.inputs}});
    if (row.model) rows.back()["model"] = to_json(*row.model);
  }
  for (const ContrastConfig& one : study.contrasts) {
    object["contrast"].push_back(
        {{"id", one.id}, {"title", one.title}, {"from", one.from}, {"to", one.to}});
  }
  for (const SweepAxis& sweep : study.sweeps) {
    ordered_json keys = ordered_json::array();
    for (const SweepKey& key : sweep.keys) keys.push_back({{"key", key.path}, {"unit", key.unit}});
    object["sweep"].push_back({{"id", sweep.id}, {"keys", keys}, {"points", sweep.points.size()}});
  }
  return object;
}

}  // namespace flexspline::studies
