#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/studies/conceal.hpp"

namespace flexspline::studies {

/// Where concealed recordings come from, one file each in studies/generators. Unrelated ones keep a
/// diagnosis from learning a bench.
struct GeneratorRow {
  std::string_view id;
  std::string_view summary;
  std::vector<data::BenchKind> rigs;
  /// Ids of a class that it can hide where a plan says so.
  std::vector<std::string> (*effects)(const ConcealPlan& plan, data::HiddenClass of) = nullptr;
  /// Errors: input_missing where what it needs is not here; usage for what it cannot hide.
  Result<ConcealedCase> (*make)(const ConcealPlan& plan) = nullptr;
};

std::span<const GeneratorRow> generators();

/// Null where there is none of the name.
const GeneratorRow* find_generator(std::string_view id);

/// Recordings named by nothing: the set is called "case", its recordings stand in an order drawn
/// from the seed alone.
RecordingSet disguised(RecordingSet set, std::uint64_t seed);

}  // namespace flexspline::studies
