#include <algorithm>

#include <fmt/format.h>

#include "conceal/conceal_reader.hpp"
#include "conceal/generator.hpp"
#include "config/toml_root.hpp"
#include "flexspline/core/nearest_name.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/studies/trial.hpp"

namespace flexspline::studies {
namespace {

constexpr std::string_view kSchema = "flexspline-trial/1";

std::vector<data::BenchKind> read_rigs(TomlSection& root) {
  std::vector<data::BenchKind> rigs;
  for (const std::string& name : root.texts("rigs")) {
    const std::optional<data::BenchKind> rig = data::find_bench_kind(name);
    if (!rig) {
      root.refuse("rigs", fmt::format("unknown rig '{}'", name),
                  suggestion(name, bench_kind_names()));
    } else if (std::ranges::find(rigs, *rig) != rigs.end()) {
      root.refuse("rigs", fmt::format("rig '{}' stands there twice", name), "name it once");
    } else {
      rigs.push_back(*rig);
    }
  }
  const toml::array* list = root.raw()["rigs"].as_array();
  if (!root.has("rigs") || (list != nullptr && list->empty())) {
    root.refuse("rigs", "the trial has no rig", "write rigs = [\"locked\", \"free\"]");
  }
  return rigs;
}

void read_generators(TomlSection& root, TrialConfig& trial) {
  std::vector<std::string_view> known;
  for (const GeneratorRow& row : generators()) known.push_back(row.id);
  if (root.has("generators")) trial.generators = root.texts("generators");
  for (const std::string& id : trial.generators) {
    const GeneratorRow* row = find_generator(id);
    if (row == nullptr) {
      root.refuse("generators", fmt::format("unknown generator '{}'", id), suggestion(id, known));
    } else if (!trial.rigs.empty() && std::ranges::none_of(trial.rigs, [row](data::BenchKind rig) {
                 return std::ranges::find(row->rigs, rig) != row->rigs.end();
               })) {
      root.refuse("generators", fmt::format("generator '{}' has none of the trial's rigs", id),
                  "add one of its rigs");
    }
  }
  if (trial.generators.empty()) {
    root.refuse("generators", "the trial has no generator", "write generators = [\"bench\"]");
  }
}

bool uses(const TrialConfig& trial, std::string_view generator) {
  return std::ranges::find(trial.generators, generator) != trial.generators.end();
}

/// Where paths of a trial begin.
struct Folders {
  std::filesystem::path file;
  std::filesystem::path data;
};

void read_sources(TomlSection& root, TrialConfig& trial, const Folders& folders) {
  if (auto mujoco = root.table("mujoco")) {
    trial.mujoco_script = folders.file / mujoco->required_text("script");
    mujoco->refuse_unknown_keys();
  } else if (uses(trial, "mujoco")) {
    root.refuse("generators", "generator 'mujoco' has no script",
                "write [mujoco] script = \"../data/bench/mujoco/make.mjs\"");
  }
  if (auto splice = root.table("splice")) {
    for (const std::string& set : splice->texts("datasets")) {
      trial.spliced_sets.push_back(folders.data / set);
    }
    splice->refuse_unknown_keys();
  }
  if (uses(trial, "splice") && trial.spliced_sets.empty()) {
    root.refuse("generators", "generator 'splice' has no recordings",
                "write [splice] datasets = [\"path/of/a/data/set\"]");
  }
}

void read_cases(TomlSection& root, TrialConfig& trial) {
  constexpr int kMostCases = 10'000;
  trial.cases = static_cast<int>(root.integer("cases", 1, kMostCases).value_or(0));
  if (!root.has("cases")) root.refuse("cases", "'cases' is missing", "say how many, cases = 60");
}

TrialConfig read_config(TomlSection& root, const Folders& folders) {
  TrialConfig trial;
  check_schema(root, kSchema);
  trial.name = root.required_text("name");
  trial.title = root.text("title").value_or(trial.name);
  trial.seed = read_seed(root);
  trial.rigs = read_rigs(root);
  read_generators(root, trial);
  read_sources(root, trial, folders);
  read_cases(root, trial);
  trial.time_limit = root.quantity("time_limit", Dimension::time, 1e-3).value_or(trial.time_limit);
  if (auto draw = root.table("draw")) trial.draw = read_draw(*draw, trial.rigs);
  if (auto nuisances = root.table("nuisances")) trial.nuisances = read_nuisances(*nuisances);
  root.refuse_unknown_keys();
  return trial;
}

}  // namespace

TrialReading read_trial_text(const std::string& text, const std::filesystem::path& file,
                             const std::filesystem::path& data_root) {
  const Folders folders{file.parent_path(), data_root.empty() ? file.parent_path() : data_root};
  TrialConfig trial;
  TrialReading reading;
  reading.errors =
      read_toml_text(text, file, [&](TomlSection& root) { trial = read_config(root, folders); });
  trial.file = file;
  trial.data_root = folders.data;
  if (reading.errors.empty()) reading.trial = std::move(trial);
  return reading;
}

Result<TrialReading> read_trial(const std::filesystem::path& file,
                                const std::filesystem::path& data_root) {
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  return read_trial_text(*text, file, data_root);
}

Result<TrialConfig> load_trial(const std::filesystem::path& file,
                               const std::filesystem::path& data_root) {
  auto reading = read_trial(file, data_root);
  if (!reading) return tl::unexpected(reading.error());
  if (!reading->trial) return tl::unexpected(as_error(reading->errors));
  return *std::move(reading->trial);
}

}  // namespace flexspline::studies
