#include <algorithm>

#include <fmt/format.h>

#include "conceal/conceal_reader.hpp"
#include "config/toml_root.hpp"
#include "flexspline/core/nearest_name.hpp"
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

void read_cases(TomlSection& root, TrialConfig& trial) {
  constexpr int kMostCases = 10'000;
  trial.cases = static_cast<int>(root.integer("cases", 1, kMostCases).value_or(0));
  if (!root.has("cases")) root.refuse("cases", "'cases' is missing", "say how many, cases = 60");
}

TrialConfig read_config(TomlSection& root) {
  TrialConfig trial;
  check_schema(root, kSchema);
  trial.name = root.required_text("name");
  trial.title = root.text("title").value_or(trial.name);
  trial.seed = read_seed(root);
  trial.rigs = read_rigs(root);
  read_cases(root, trial);
  trial.time_limit = root.quantity("time_limit", Dimension::time, 1e-3).value_or(trial.time_limit);
  if (auto draw = root.table("draw")) trial.draw = read_draw(*draw, trial.rigs);
  if (auto nuisances = root.table("nuisances")) trial.nuisances = read_nuisances(*nuisances);
  root.refuse_unknown_keys();
  return trial;
}

}  // namespace

Result<TrialReading> read_trial(const std::filesystem::path& file) {
  TrialConfig trial;
  auto findings = read_toml_root(file, [&](TomlSection& root) { trial = read_config(root); });
  if (!findings) return tl::unexpected(findings.error());
  TrialReading reading{std::nullopt, *std::move(findings)};
  trial.file = file;
  if (reading.errors.empty()) reading.trial = std::move(trial);
  return reading;
}

Result<TrialConfig> load_trial(const std::filesystem::path& file) {
  auto reading = read_trial(file);
  if (!reading) return tl::unexpected(reading.error());
  if (!reading->trial) return tl::unexpected(as_error(reading->errors));
  return *std::move(reading->trial);
}

}  // namespace flexspline::studies
