#include "ode_fit/statistics.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "ode_fit/verdict.hpp"
#include "ode_fit/weighted_shooting.hpp"
#include "uncertainty/covariance.hpp"
#include "uncertainty/intervals.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kAtBound = 1e-6;  // distance from a bound, in scales, that counts as on it
constexpr double kUpper = 0.975;

double quantile(double freedom, bool noise_known) {
  if (noise_known) return boost::math::quantile(boost::math::normal_distribution<>(), kUpper);
  if (!(freedom > 0.0)) return kNotComputed;
  return boost::math::quantile(boost::math::students_t_distribution<>(freedom), kUpper);
}

// Directions that neither bounds nor active inequalities forbid, as columns.
Eigen::MatrixXd free_directions(const OdeSolution& solution, const std::vector<bool>& active) {
  const auto count = static_cast<Eigen::Index>(active.size());
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < count; ++k) {
    if (!active[static_cast<std::size_t>(k)]) free.push_back(k);
  }
  Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(count, count)(Eigen::all, free);
  if (solution.active_gradients.rows() == 0 || free.empty()) return basis;
  const Eigen::MatrixXd normal = (solution.active_gradients * basis).transpose();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(normal);
  const Eigen::MatrixXd q = qr.householderQ();
  return basis * q.rightCols(q.cols() - qr.rank());
}

// Standard deviation of the residuals as the covariance needs it: with a robust loss Huber's
// (1981, eq. 7.6.5) from influences and their slopes, which is the plain one for the square.
double noise_factor(const RobustLoss& loss, const Eigen::VectorXd& residual, double parameters) {
  const auto n = static_cast<double>(residual.size());
  if (!(n > parameters)) return kNotComputed;
  double squares = 0.0;
  double slope = 0.0;
  double slope_squares = 0.0;
  for (const double r : residual) {
    squares += std::pow(loss.influence(r), 2);
    slope += loss.curvature(r) / n;
    slope_squares += std::pow(loss.curvature(r), 2) / n;
  }
  if (!(slope > 0.0)) return kNotComputed;
  const double spread = std::max(0.0, slope_squares - slope * slope);
  const double correction = 1.0 + parameters / n * spread / (slope * slope);
  return correction * std::sqrt(squares / (n - parameters)) / slope;
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

// Residuals and Jacobian before the loss.
Result<Linearisation> linear_at(const OdeLayout& layout, std::span<const double> q,
                                double tolerance) {
  OdeLayout plain = layout;
  plain.loss = {};
  const ShootingProblem shots(plain, tolerance, 1);
  return linearise(WeightedShooting(plain, shots), q);
}

// Rows of each output of each experiment: a series of noise.
std::vector<NoiseSeries> series_of(const OdeLayout& layout) {
  std::vector<NoiseSeries> list;
  std::size_t first = 0;
  for (const auto& experiment : layout.experiments) {
    for (std::size_t o = 0; o < experiment.outputs(); ++o) {
      list.push_back(rows_of(experiment, o).row);
      for (std::size_t& row : list.back()) row += first;
    }
    first += experiment.residuals(0, experiment.source.times.size());
  }
  return list;
}

Result<void> add_intervals(const OdeLayout& layout, const std::vector<double>& q, double factor,
                           const OdeFitSettings& settings, OdeFit& fit) {
  if (settings.uncertainty.kind == Uncertainty::covariance) return {};
  if (layout.inequalities != nullptr) {
    fit.notes.emplace_back(
        "intervals are those of the covariance: refits would leave the inequalities "
        "out");
    return {};
  }
  const ShootingProblem shots(layout, settings.integration_tolerance, 1);
  const WeightedShooting problem(layout, shots);
  const auto bounds = shots.bounded_parameters();
  const double variance = settings.noise_known ? 1.0 : fit.noise_factor * fit.noise_factor;
  const auto found = intervals({problem, bounds, q, fit.covariance, variance, factor,
                                settings.noise_known, series_of(layout)},
                               settings.uncertainty,
                               {.max_iterations = settings.max_iterations,
                                .function_tolerance = 1e-12,
                                .parameter_tolerance = 1e-12});
  if (!found) return tl::unexpected(in_context(found.error(), "the intervals"));
  for (std::size_t k = 0; k < q.size(); ++k) {
    fit.parameters[k].ci95_lower = found->lower[k];
    fit.parameters[k].ci95_upper = found->upper[k];
    if (!found->std.empty()) fit.parameters[k].std = found->std[k];
  }
  if (found->covariance.size() > 0) fit.covariance = found->covariance;
  fit.notes.insert(fit.notes.end(), found->notes.begin(), found->notes.end());
  return {};
}

}  // namespace

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

Result<OdeFit> with_statistics(const OdeLayout& layout, const OdeSolution& solution,
                               const OdeFitSettings& settings) {
  OdeFit fit{.cost = solution.cost,
             .termination = solution.termination,
             .iterations = solution.iterations,
             .evaluations = solution.evaluations,
             .gap = solution.gap,
             .elements = solution.elements,
             .notes = solution.notes,
             .active_inequalities = solution.active_inequalities};
  std::vector<double> q = solution.q;
  const auto active = settle_on_bounds(layout, q);
  if (layout.inequalities != nullptr) {
    const auto parameters = std::span(q).first(layout.system->parameters());
    for (auto& says : layout.inequalities->between(parameters))
      fit.notes.push_back(std::move(says));
  }
  const auto count = static_cast<Eigen::Index>(q.size());
  fit.covariance = Eigen::MatrixXd::Constant(count, count, kNotComputed);
  const auto at = linear_at(layout, q, settings.integration_tolerance);
  if (at) {
    const Eigen::MatrixXd free = free_directions(solution, active);
    fit.residuals.assign(at->residual.begin(), at->residual.end());
    fit.degrees_of_freedom =
        static_cast<double>(fit.residuals.size()) - static_cast<double>(free.cols());
    fit.noise_factor = noise_factor(layout.loss, at->residual, static_cast<double>(free.cols()));
    const bool known = settings.noise_known && layout.loss.squared();
    const double noise = known ? 1.0 : fit.noise_factor;
    const Eigen::MatrixXd j = at->jacobian * free;
    fit.covariance = free *
                     sandwich(j, noise * noise * j.transpose() * j,
                              std::vector<bool>(static_cast<std::size_t>(j.cols()), false)) *
                     free.transpose();
    fit.identifiability = verdict(layout, q, free, at->jacobian, noise, settings.propose_recording);
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
  if (at) {
    if (auto added = add_intervals(layout, q, factor, settings, fit); !added) {
      return tl::unexpected(added.error());
    }
  }
  return fit;
}

}  // namespace flexspline::estimators
