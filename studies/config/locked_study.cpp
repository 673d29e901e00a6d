#include <sstream>

#include <fmt/format.h>
#include <toml++/toml.h>
#include <nlohmann/json.hpp>

#include "config/locked_json.hpp"
#include "config/study_source.hpp"
#include "config/toml_root.hpp"
#include "flexspline/core/nesting.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/studies/verify.hpp"

namespace flexspline::studies {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

BenchConfig bench_from(const json& from) {
  BenchConfig bench;
  bench.sensors.encoder_step = from.at("encoder_step_rad");
  bench.sensors.angle_noise = from.at("angle_noise");
  bench.sensors.torque_noise_white = from.at("torque_noise_white");
  bench.sensors.torque_noise_coloured = from.at("torque_noise_coloured");
  bench.sensors.torque_noise_samples = from.at("torque_noise_samples");
  bench.sensors.time_jitter = from.value("time_jitter", 0.0);
  bench.sensors.missing_samples = from.value("missing_samples", 0.0);
  bench.cycles = from.at("cycles");
  bench.samples_per_cycle = from.at("samples_per_cycle");
  return bench;
}

Grid grid_from(const json& from) {
  Grid grid;
  grid.id = from.at("id");
  for (const json& loop : from.at("loops_rad_hz")) grid.loops.push_back({loop.at(0), loop.at(1)});
  return grid;
}

fs::path found(const std::string& dataset, const fs::path& data_root) {
  if (dataset.empty() || file_exists(dataset) || data_root.empty()) return dataset;
  return data_root / dataset;
}

InputConfig input_from(const json& from, const fs::path& data_root) {
  InputConfig input;
  input.id = from.at("id");
  input.title = from.at("title");
  input.truth = from.at("truth");
  input.dataset = found(from.at("dataset"), data_root);
  input.holdout = from.at("holdout");
  if (from.contains("bench")) input.bench = bench_from(from.at("bench"));
  input.strength = from.value("strength", std::map<std::string, double>{});
  input.rows = from.value("rows", data::kMostRows);
  if (from.contains("held_out")) {
    input.held_out = from.at("held_out").get<std::vector<std::string>>();
  }
  return input;
}

EstimatorConfig estimator_from(const json& from) {
  EstimatorConfig estimator;
  estimator.id = from.at("id");
  estimator.title = from.at("title");
  estimator.method = from.at("method");
  estimator.train = from.at("train");
  estimator.steady = from.at("steady");
  estimator.inputs = from.at("inputs").get<std::vector<std::string>>();
  for (const auto& [name, value] : from.at("options").items()) {
    if (value.is_number()) {
      estimator.options.numbers[name] = value;
    } else {
      estimator.options.words[name] = value;
    }
  }
  return estimator;
}

ContrastConfig contrast_from(const json& from) {
  return {from.at("id"), from.at("title"), from.at("from"), from.at("to")};
}

StudyConfig study_from(const json& from, const fs::path& data_root) {
  StudyConfig study;
  study.name = from.at("name");
  study.title = from.at("title");
  study.seed = from.at("seed");
  study.replicates = from.at("replicates");
  study.paper = from.at("paper");
  study.bench = bench_from(from.at("bench"));
  const json none = json::array();
  for (const json& one : from.value("grid", none)) study.grids.push_back(grid_from(one));
  for (const json& one : from.value("input", none)) {
    study.inputs.push_back(input_from(one, data_root));
  }
  for (const json& one : from.value("estimator", none)) {
    study.estimators.push_back(estimator_from(one));
  }
  for (const json& one : from.value("contrast", none)) {
    study.contrasts.push_back(contrast_from(one));
  }
  return study;
}

/// A study of another kind than a grid, or with sweeps, from the text of its file.
Result<StudyConfig> from_source(const json& source, const fs::path& data_root) {
  const fs::path written_root = source.at("data_root").get<std::string>();
  const fs::path file = source.at("file").get<std::string>();
  auto reading =
      read_study_text(source.at("text"), file, data_root.empty() ? written_root : data_root,
                      source.at("model_root").get<std::string>());
  if (!reading.study) return tl::unexpected(as_error(reading.errors));
  return std::move(*reading.study);
}

/// A model file is written into the lock as it was understood, and not read back from there.
bool has_model(const json& study) {
  const json none = json::array();
  for (const json& one : study.value("estimator", none)) {
    if (one.contains("model")) return true;
  }
  return false;
}

/// Whether the configuration as understood says all of it: a grid without sweeps and model files.
bool is_whole(const json& study) {
  return study.value("kind", "grid") == "grid" && !study.contains("sweep") && !has_model(study);
}

}  // namespace

Result<json> read_lock_json(const fs::path& lock) {
  const auto text = read_file(lock);
  if (!text) return tl::unexpected(text.error());
  if (const auto flat = check_nesting(*text); !flat) {
    return tl::unexpected(in_context(flat.error(), lock.string()));
  }
  try {
    std::ostringstream out;
    out << toml::json_formatter{toml::parse(*text, lock.string())};
    return json::parse(out.str());
  } catch (const toml::parse_error& error) {
    return failure(ErrorCode::bad_data, fmt::format("{}: {}", lock.string(), error.description()));
  } catch (const json::exception& error) {
    return failure(ErrorCode::bad_data, fmt::format("{}: {}", lock.string(), error.what()));
  }
}

Result<StudyConfig> read_locked_study(const fs::path& lock, const fs::path& data_root) {
  const auto locked = read_lock_json(lock);
  if (!locked) return tl::unexpected(locked.error());
  try {
    const json& study = locked->at("study");
    if (locked->contains("source") && !is_whole(study)) {
      return from_source(locked->at("source"), data_root);
    }
    if (has_model(study)) {
      return failure(ErrorCode::bad_data, lock.string() + " holds a model file's content",
                     "give the study file itself");
    }
    StudyConfig config = study_from(study, data_root);
    config.file = lock;
    return config;
  } catch (const json::exception& error) {
    return failure(ErrorCode::bad_data, fmt::format("{}: {}", lock.string(), error.what()),
                   "it is not a study.lock.toml of this version: give the study file itself");
  }
}

}  // namespace flexspline::studies
