#include "flexspline/estimators/given_parameters.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "flexspline/core/drive_spec.hpp"
#include "flexspline/core/effect.hpp"
#include "flexspline/core/nearest_name.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();
const std::vector<std::string> kHeldByDefault = {".smoothing", ".load_smoothing", ".rounding",
                                                 ".order"};

bool matches(const std::string& pattern, const std::string& name) {
  if (pattern.starts_with('.')) return name.ends_with(pattern);
  return name == pattern || name.starts_with(pattern + ".") || name.starts_with(pattern + "[");
}

bool matches_any(const std::vector<std::string>& patterns, const std::string& name) {
  return std::ranges::any_of(patterns, [&](const auto& one) { return matches(one, name); });
}

void bound_law(const LawSpec& law, std::size_t k, GivenParameter& parameter) {
  if (law.law == "monotone_spline") parameter.lower = 0.0;
  if (law.law == "power_law" && k == 1) {
    parameter.lower = 0.2;
    parameter.upper = 5.0;
  }
}

Result<void> bound_effects(const ModelSpec& model, std::size_t k,
                           std::vector<GivenParameter>& parameters) {
  for (const EffectSpec& spec : model.effects) {
    const auto row = find_effect(spec.effect);
    if (!row) return tl::unexpected(row.error());
    for (std::size_t j = 0; j < spec.parameters.size(); ++j, ++k) {
      const EffectParameter& info = (*row)->parameters[j % (*row)->parameters.size()];
      parameters[k].lower = info.lower;
      parameters[k].upper = info.upper;
    }
  }
  return {};
}

Result<void> check_patterns(const std::vector<std::string>& patterns,
                            const std::vector<GivenParameter>& parameters) {
  for (const std::string& pattern : patterns) {
    const auto named = [&](const GivenParameter& one) { return matches(pattern, one.name); };
    if (std::ranges::any_of(parameters, named)) continue;
    std::vector<std::string_view> names;
    for (const auto& one : parameters) names.emplace_back(one.name);
    const auto nearest = nearest_name(pattern, names);
    return failure(ErrorCode::bad_data,
                   fmt::format("the model has no parameter '{}' to hold or free", pattern),
                   nearest ? fmt::format("did you mean '{}'?", *nearest)
                           : fmt::format("it has {}", fmt::join(names, ", ")));
  }
  return {};
}

Result<void> check_starts(const std::vector<GivenParameter>& parameters) {
  for (const GivenParameter& one : parameters) {
    if (one.start >= one.lower && one.start <= one.upper) continue;
    return failure(ErrorCode::bad_data,
                   fmt::format("{} starts at {:.6g} {}", one.name, one.start, one.unit),
                   fmt::format("it lies in [{:.6g}, {:.6g}]", one.lower, one.upper));
  }
  return {};
}

}  // namespace

Result<std::vector<GivenParameter>> given_parameters(const GivenModel& given) {
  std::vector<GivenParameter> list;
  for (const DriveParameter& one : parameters_of({.torsion = given.model}, {})) {
    list.push_back({one.name, one.unit, one.value, -kNoBound, kNoBound, false});
  }
  std::size_t k = 0;
  for (const LawSpec* law : {&given.model.f, &given.model.g_inverse, &given.model.h}) {
    for (std::size_t j = 0; j < law->coefficients.size(); ++j) bound_law(*law, j, list[k++]);
  }
  if (auto bounded = bound_effects(given.model, k, list); !bounded) {
    return tl::unexpected(bounded.error());
  }
  for (const auto* patterns : {&given.hold, &given.free}) {
    if (auto known = check_patterns(*patterns, list); !known) return tl::unexpected(known.error());
  }
  if (auto within = check_starts(list); !within) return tl::unexpected(within.error());
  for (GivenParameter& one : list) {
    const bool wanted = matches_any(given.hold, one.name) || matches_any(kHeldByDefault, one.name);
    one.held = wanted && !matches_any(given.free, one.name);
  }
  return list;
}

}  // namespace flexspline::estimators
