#include <fmt/format.h>

#include "config/study_reader.hpp"

namespace flexspline::studies {
namespace {

/// loops = { values = [[0.2, 0.005], …], units = ["deg", "Hz"] }
std::vector<Loop> read_pairs(TomlSection& grid) {
  std::optional<TomlSection> list = grid.table("loops");
  if (!list) return {};
  std::vector<Loop> loops;
  const toml::node* values = list->node("values");
  const std::vector<std::string> units = list->texts("units");
  list->refuse_unknown_keys();
  const std::optional<Unit> first = units.size() == 2 ? find_unit(units[0]) : std::nullopt;
  const std::optional<Unit> second = units.size() == 2 ? find_unit(units[1]) : std::nullopt;
  if (!first || first->dimension != Dimension::angle || !second ||
      second->dimension != Dimension::frequency) {
    list->refuse(
        "units",
        fmt::format("'{}' is not a unit of angle and one of frequency", list->name_of("units")),
        "write units = [\"deg\", \"Hz\"]");
    return {};
  }
  const toml::array* rows = values == nullptr ? nullptr : values->as_array();
  if (rows == nullptr || rows->empty()) {
    list->refuse("values", fmt::format("'{}' holds no loop", list->name_of("values")),
                 "write values = [[0.2, 0.005]]");
    return {};
  }
  for (const toml::node& row : *rows) {
    const auto pair = list->numbers(row, list->name_of("values"));
    if (!pair) continue;
    if (pair->size() != 2 || !((*pair)[0] > 0.0) || !((*pair)[1] > 0.0)) {
      list->refuse_at(row, "a loop is not a positive amplitude and a positive frequency",
                      "write [0.2, 0.005]");
      continue;
    }
    loops.push_back({to_si(*first, (*pair)[0]), to_si(*second, (*pair)[1])});
  }
  return loops;
}

std::vector<Loop> read_product(TomlSection& grid) {
  std::vector<Loop> loops;
  const std::vector<double> amplitudes = grid.quantities("amplitude", Dimension::angle);
  const std::vector<double> frequencies = grid.quantities("frequency", Dimension::frequency);
  for (const double amplitude : amplitudes) {
    for (const double frequency : frequencies) loops.push_back({amplitude, frequency});
  }
  return loops;
}

void refuse_repeated_loops(TomlSection& section, const Grid& grid) {
  for (std::size_t i = 0; i < grid.loops.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (recording_id(grid.loops[i]) != recording_id(grid.loops[j])) continue;
      section.refuse(
          "id", fmt::format("grid '{}' holds loop {} twice", grid.id, recording_id(grid.loops[i])),
          "name each loop once");
    }
  }
}

}  // namespace

std::string recording_id(const Loop& loop) {
  constexpr double kDegreesPerRad = 57.29577951308232;
  return fmt::format("a{:.4f}-f{:.5f}", loop.amplitude * kDegreesPerRad, loop.frequency_hz);
}

Grid read_grid(TomlSection& section) {
  Grid grid;
  grid.id = section.required_text("id");
  const bool listed = section.has("loops");
  const bool product = section.has("amplitude") || section.has("frequency");
  if (listed && product) {
    section.refuse("loops",
                   fmt::format("grid '{}' has loops beside amplitude or frequency", grid.id),
                   "give either loops, or amplitude and frequency");
  }
  grid.loops = read_product(section);
  const std::vector<Loop> pairs = read_pairs(section);
  if (listed) grid.loops = pairs;
  if (!listed && !(section.has("amplitude") && section.has("frequency"))) {
    section.refuse("id", fmt::format("grid '{}' is empty", grid.id),
                   "give amplitude and frequency, or loops");
  }
  if (grid.id == kTrainAll || grid.id == kTrainOne) {
    section.refuse("id", fmt::format("grid id '{}' is reserved", grid.id),
                   "all and one name the training recordings of a data set");
  }
  refuse_repeated_loops(section, grid);
  section.refuse_unknown_keys();
  return grid;
}

BenchConfig read_bench(TomlSection& section, BenchConfig bench) {
  const auto set = [&](double& member, std::string_view key, Dimension dimension) {
    member = section.quantity(key, dimension, 0.0).value_or(member);
  };
  set(bench.sensors.encoder_step, "encoder_step", Dimension::angle);
  set(bench.sensors.angle_noise, "angle_noise", Dimension::dimensionless);
  set(bench.sensors.torque_noise_white, "torque_noise_white", Dimension::dimensionless);
  set(bench.sensors.torque_noise_coloured, "torque_noise_coloured", Dimension::dimensionless);
  if (const auto samples = section.integer("torque_noise_samples", 1, 100000)) {
    bench.sensors.torque_noise_samples = static_cast<double>(*samples);
  }
  set(bench.sensors.time_jitter, "time_jitter", Dimension::dimensionless);
  set(bench.sensors.missing_samples, "missing_samples", Dimension::dimensionless);
  bench.cycles = static_cast<int>(section.integer("cycles", 3, 1000).value_or(bench.cycles));
  bench.samples_per_cycle = static_cast<int>(
      section.integer("samples_per_cycle", 32, 100000).value_or(bench.samples_per_cycle));
  section.refuse_unknown_keys();
  return bench;
}

}  // namespace flexspline::studies
