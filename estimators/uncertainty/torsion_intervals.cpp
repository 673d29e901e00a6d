#include "uncertainty/torsion_intervals.hpp"

#include <algorithm>

#include "torsion/torque_residuals.hpp"
#include "torsion/torsion_residuals.hpp"
#include "uncertainty/covariance.hpp"

namespace flexspline::estimators {
namespace {

// How much more a parameter varies than residuals of variance 1 would have it.
std::vector<double> inflations(const TrajectoryFit& fit) {
  const Eigen::MatrixXd& j = fit.linear.jacobian;
  const Eigen::MatrixXd plain = sandwich(j, j.transpose() * j, fit.solution.bound_active);
  std::vector<double> list;
  for (Eigen::Index k = 0; k < plain.rows(); ++k) {
    const double ratio = plain(k, k) > 0.0 ? fit.covariance(k, k) / plain(k, k) : 1.0;
    list.push_back(std::max(1.0, ratio));
  }
  return list;
}

Result<Intervals> of(const LeastSquaresProblem& problem, const TrajectoryFit& fit,
                     const std::vector<PreparedRecord>& records,
                     const UncertaintySettings& settings, SolverSettings solver) {
  solver.function_tolerance = std::min(solver.function_tolerance, 1e-11);
  solver.parameter_tolerance = std::min(solver.parameter_tolerance, 1e-11);
  auto bounds = bounded_parameters(fit.at.layout, records, fit.at.p);
  // The filters of the residuals stand where the fit ended: settle there first.
  const auto settled = minimise(problem, bounds, solver);
  if (!settled) return tl::unexpected(settled.error());
  return intervals({.problem = problem,
                    .parameters = bounds,
                    .p = settled->p,
                    .covariance = fit.covariance,
                    .variances = inflations(fit)},
                   settings, solver);
}

}  // namespace

Result<Intervals> torsion_intervals(const TrajectoryFit& fit,
                                    const std::vector<PreparedRecord>& records,
                                    const UncertaintySettings& settings,
                                    const SolverSettings& solver,
                                    const IntegratorSettings& integrator) {
  if (settings.kind == Uncertainty::covariance) return Intervals{};
  if (fit.direction == Direction::torque) {
    return of(TorqueResiduals(fit.at.layout, records), fit, records, settings, solver);
  }
  TorsionResiduals problem(fit.at.layout, records, integrator);
  if (auto weighed = problem.weigh(fit.at.p); !weighed) return tl::unexpected(weighed.error());
  return of(problem, fit, records, settings, solver);
}

}  // namespace flexspline::estimators
