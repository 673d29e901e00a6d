#include "given_model/held_fit.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "flexspline/core/drive_spec.hpp"
#include "given_model/given_estimate.hpp"
#include "uncertainty/covariance.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kShare = 0.1;  // of a value that has no standard deviation

double held_value(const ParameterEstimate& one, const GivenParameter& bounds, double deviations) {
  const bool known = one.std > 0.0 && std::isfinite(one.std);
  const double step = known ? one.std : kShare * std::max(std::abs(one.value), kShare);
  return std::clamp(one.value + deviations * step, bounds.lower, bounds.upper);
}

/// The free fit's model with that number in it, and the number held.
GivenModel held_at(const GivenModel& given, const ModelSpec& fitted,
                   const std::vector<GivenParameter>& parameters, const std::string& name,
                   double value) {
  std::vector<double> values;
  for (const GivenParameter& one : parameters) {
    values.push_back(one.name == name ? value : one.start);
  }
  GivenModel made = given;
  made.model = with_parameters({.torsion = fitted}, {}, values).torsion;
  std::erase(made.free, name);
  made.hold.push_back(name);
  return made;
}

}  // namespace

Result<Estimate> held_fit(const GivenModel& given, const Estimate& free,
                          const std::vector<GivenRecord>& records, GivenSearchSettings settings,
                          const HeldAway& away) {
  const auto fitted = given_parameters({free.model, given.hold, given.free});
  if (!fitted) return tl::unexpected(fitted.error());
  const std::size_t count = free.parameters.size();
  const std::string name = away.parameter < count ? free.parameters[away.parameter].name : "";
  const auto own = std::ranges::find(*fitted, name, &GivenParameter::name);
  if (own == fitted->end()) {
    return failure(ErrorCode::usage,
                   fmt::format("the fit has no parameter {} of its model", away.parameter + 1),
                   fmt::format("it has {}", count));
  }
  const double value = held_value(free.parameters[away.parameter], *own, away.deviations);
  const GivenModel held = held_at(given, free.model, *fitted, name, value);
  const auto parameters = given_parameters(held);
  if (!parameters) return tl::unexpected(parameters.error());
  settings.starts = 1;
  settings.first_start = 0;
  settings.start_steps = 0;
  const auto found = search_given(held.model, *parameters, records, settings);
  if (!found) return tl::unexpected(found.error());
  const auto linear = linearise(found->residuals, found->solution.p);
  if (!linear) return tl::unexpected(linear.error());
  Estimate estimate = given_estimate(found->residuals, found->solution, *linear, records);
  ParameterEstimate one;
  one.name = name;
  one.value = value;
  one.unit = own->unit;
  estimate.parameters.push_back(std::move(one));
  estimate.notes.push_back(fmt::format("{} was held at {:.6g} {}", name, value, own->unit));
  return estimate;
}

}  // namespace flexspline::estimators
