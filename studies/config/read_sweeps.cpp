#include <algorithm>

#include <fmt/format.h>

#include "config/study_source.hpp"

namespace flexspline::studies {
namespace {

constexpr std::int64_t kMostSamples = 10'000'000;

/// Several keys, each with a list of its own, set together point by point.
SweepAxis read_zip(TomlSection& section) {
  SweepAxis sweep;
  for (TomlSection& one : section.tables("zip")) {
    SweepKey key;
    const auto values = read_sweep_values(one, key);
    one.refuse_unknown_keys();
    if (!sweep.keys.empty() && values.size() != sweep.points.size()) {
      one.refuse("key",
                 fmt::format("'{}' has {} values, '{}' before it {}", key.path, values.size(),
                             sweep.keys.front().path, sweep.points.size()),
                 "keys of one zip have as many values each");
      continue;
    }
    sweep.points.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) sweep.points[i].push_back(values[i]);
    sweep.keys.push_back(std::move(key));
  }
  return sweep;
}

SweepAxis read_sampled(TomlSection& section, std::string_view design, std::uint64_t seed) {
  auto own = section.table(design);
  if (!own) return {};
  if (!own->has("count")) {
    own->refuse("count", fmt::format("'{}' is missing", own->name_of("count")), "add count = 64");
  }
  const auto count = own->integer("count", 1, kMostSamples);
  const auto ranges = read_sweep_ranges(*own);
  own->refuse_unknown_keys();
  SweepAxis sweep;
  if (!count || ranges.empty()) return sweep;
  const auto number = static_cast<std::size_t>(*count);
  const auto unit = design == "sobol" ? sobol_points(number, ranges.size())
                                      : latin_hypercube(number, ranges.size(), seed);
  for (const SweepRange& range : ranges) sweep.keys.push_back(range.key);
  for (const auto& u : unit) {
    auto& point = sweep.points.emplace_back();
    for (std::size_t d = 0; d < ranges.size(); ++d) point.push_back(ranges[d].at(u[d]));
  }
  return sweep;
}

SweepAxis read_sweep(TomlSection& section, std::uint64_t seed) {
  const std::string id = section.text("id").value_or("");
  SweepAxis sweep;
  const auto has = [&](std::string_view key) { return section.has(key); };
  const int forms =
      int(has("key")) + int(has("zip")) + int(has("latin_hypercube")) + int(has("sobol"));
  if (forms != 1) {
    section.refuse("key",
                   fmt::format("a sweep has {} of key, zip, latin_hypercube and sobol",
                               forms == 0 ? "none" : "more than one"),
                   "write [[sweep]] key = \"bench.cycles\", values = [3, 5]");
  } else if (has("key")) {
    SweepKey key;
    for (SweepValue& value : read_sweep_values(section, key)) sweep.points.push_back({value});
    sweep.keys.push_back(std::move(key));
  } else if (has("zip")) {
    sweep = read_zip(section);
  } else {
    sweep = read_sampled(section, has("sobol") ? "sobol" : "latin_hypercube", seed);
  }
  section.refuse_unknown_keys();
  sweep.id = !id.empty() || sweep.keys.empty() ? id : sweep.keys.front().path;
  return sweep;
}

void refuse_fixed_keys(TomlSection& section, const SweepAxis& sweep) {
  for (const SweepKey& key : sweep.keys) {
    const std::string head = key.path.substr(0, key.path.find('.'));
    const std::string last = key.path.substr(key.path.rfind('.') + 1);
    const auto fixed = [&](std::initializer_list<const char*> list, const std::string& word) {
      return std::ranges::find(list, word) != list.end();
    };
    if (fixed({"schema", "name", "title", "kind", "replicates", "paper", "sweep", "contrast"},
              head) ||
        fixed({"id", "dataset", "held_out", "rows", "inputs"}, last)) {
      section.refuse("key", fmt::format("'{}' cannot be swept", key.path),
                     "it says which cases there are, not how one is computed");
    }
  }
}

}  // namespace

void read_sweeps(TomlSection& root, StudyConfig& study) {
  std::vector<std::string> before;
  for (TomlSection& section : root.tables("sweep")) {
    SweepAxis sweep = read_sweep(section, study.seed);
    refuse_fixed_keys(section, sweep);
    for (const SweepKey& key : sweep.keys) {
      if (std::ranges::find(before, key.path) != before.end()) {
        section.refuse("key", fmt::format("'{}' is swept twice", key.path), "sweep it once");
      }
      before.push_back(key.path);
    }
    if (!sweep.points.empty()) study.sweeps.push_back(std::move(sweep));
  }
}

}  // namespace flexspline::studies
