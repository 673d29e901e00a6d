#include "ode_fit/statistics.hpp"

#include <cmath>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "ode_fit/shooting_problem.hpp"
#include "uncertainty/covariance.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kAtBound = 1e-6;  // distance from a bound, in scales, that counts as on it
constexpr double kUpper = 0.975;

// Puts what lies on a bound exactly there.
std::vector<bool> settle_on_bounds(const OdeLayout& layout, std::vector<double>& q) {
  std::vector<bool> active;
  for (std::size_t k = 0; k < q.size(); ++k) {
    const auto& unknown = layout.unknowns[k];
    const bool low = q[k] - unknown.lower < kAtBound * unknown.scale;
    const bool high = unknown.upper - q[k] < kAtBound * unknown.scale;
    if (low) q[k] = unknown.lower;
    if (high) q[k] = unknown.upper;
    active.push_back(low || high);
  }
  return active;
}

double quantile(double freedom, bool noise_known) {
  if (noise_known) return boost::math::quantile(boost::math::normal_distribution<>(), kUpper);
  if (!(freedom > 0.0)) return kNotComputed;
  return boost::math::quantile(boost::math::students_t_distribution<>(freedom), kUpper);
}

ParameterEstimate estimate(const OdeParameter& parameter, double value, double variance,
                           double factor, bool active) {
  ParameterEstimate result{
      .name = parameter.name, .value = value, .unit = parameter.unit, .bound_active = active};
  if (active || !(variance > 0.0)) return result;
  result.std = std::sqrt(variance);
  result.ci95_lower = value - factor * result.std;
  result.ci95_upper = value + factor * result.std;
  return result;
}

}  // namespace

OdeFit with_statistics(const OdeLayout& layout, const OdeSolution& solution,
                       const OdeFitSettings& settings) {
  OdeFit fit{.cost = solution.cost,
             .termination = solution.termination,
             .iterations = solution.iterations,
             .evaluations = solution.evaluations,
             .gap = solution.gap,
             .elements = solution.elements,
             .notes = solution.notes};
  std::vector<double> q = solution.q;
  const auto active = settle_on_bounds(layout, q);
  const auto count = static_cast<Eigen::Index>(q.size());
  fit.covariance = Eigen::MatrixXd::Constant(count, count, kNotComputed);
  const auto at = linearise(ShootingProblem(layout, settings.integration_tolerance, 1), q);
  if (at) {
    fit.residuals.assign(at->residual.begin(), at->residual.end());
    fit.degrees_of_freedom =
        static_cast<double>(fit.residuals.size()) - static_cast<double>(q.size());
    if (fit.degrees_of_freedom > 0.0) {
      fit.noise_factor = std::sqrt(2.0 * fit.cost / fit.degrees_of_freedom);
    }
    const double noise = settings.noise_known ? 1.0 : fit.noise_factor;
    const Eigen::MatrixXd middle = noise * noise * at->jacobian.transpose() * at->jacobian;
    fit.covariance = sandwich(at->jacobian, middle, active);
  } else {
    fit.notes.push_back("no covariance: the trajectory cannot be integrated at the solution: " +
                        at.error().message());
  }
  const double factor = quantile(fit.degrees_of_freedom, settings.noise_known);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto index = static_cast<std::size_t>(k);
    fit.parameters.push_back(
        estimate(layout.unknowns[index], q[index], fit.covariance(k, k), factor, active[index]));
  }
  return fit;
}

}  // namespace flexspline::estimators
