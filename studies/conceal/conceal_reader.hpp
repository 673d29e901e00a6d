#pragma once

#include <map>
#include <optional>
#include <string>

#include "config/toml_section.hpp"
#include "flexspline/studies/conceal.hpp"

namespace flexspline::studies {

/// Parts that descriptions of a bench and of a trial share; what is wrong goes to the findings.
std::vector<std::string_view> bench_kind_names();
std::optional<data::BenchKind> read_rig(TomlSection& section, std::string_view key);
std::uint64_t read_seed(TomlSection& section);
std::map<std::string, double> read_nuisances(TomlSection& section);

/// The table of probabilities; `rigs` are those that have to find an effect in it.
ConcealDraw read_draw(TomlSection& section, const std::vector<data::BenchKind>& rigs);

/// A bare number in [low, high]; nothing when it is absent or, with a finding, wrong.
std::optional<double> read_bounded(TomlSection& section, std::string_view key, double low,
                                   double high);

}  // namespace flexspline::studies
