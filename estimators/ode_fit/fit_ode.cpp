#include "flexspline/estimators/ode_fit.hpp"
#include "ode_fit/check.hpp"
#include "ode_fit/methods.hpp"
#include "ode_fit/statistics.hpp"

namespace flexspline::estimators {
namespace {

Result<OdeSolution> solve(const OdeLayout& layout, OdeFitMethod method,
                          const OdeFitSettings& settings) {
  switch (method) {
    case OdeFitMethod::multiple_shooting:
      return multiple_shooting(layout, settings);
    case OdeFitMethod::collocation:
      return collocation(layout, settings);
    default:
      return single_shooting(layout, settings);
  }
}

}  // namespace

std::string_view name_of(OdeFitMethod method) {
  switch (method) {
    case OdeFitMethod::multiple_shooting:
      return "multiple_shooting";
    case OdeFitMethod::collocation:
      return "collocation";
    default:
      return "single_shooting";
  }
}

Result<OdeFit> fit_ode(const OdeFitProblem& problem, OdeFitMethod method,
                       const OdeFitSettings& settings) {
  if (auto checked = check(problem); !checked) return tl::unexpected(std::move(checked).error());
  const OdeLayout layout = lay_out(problem);
  auto solution = solve(layout, method, settings);
  if (!solution) {
    return tl::unexpected(in_context(std::move(solution).error(), std::string(name_of(method))));
  }
  OdeFit fit = with_statistics(layout, *solution, settings);
  fit.method = method;
  return fit;
}

}  // namespace flexspline::estimators
