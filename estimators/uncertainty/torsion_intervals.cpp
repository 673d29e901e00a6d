#include "uncertainty/torsion_intervals.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/processor_share.hpp"
#include "torsion/torque_residuals.hpp"
#include "torsion/torsion_residuals.hpp"
#include "uncertainty/bounded_draws.hpp"
#include "uncertainty/covariance.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kRounding = 1e-11;  // of a cost without an integrator
constexpr double kEnds = 1e-5;       // of a profile's ends, relative
constexpr double kNear = 2.0;        // standard deviations
constexpr Eigen::Index kDraws = 3000;
constexpr std::uint64_t kSeed = 1;

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
                     const UncertaintySettings& settings, SolverSettings solver, double noise) {
  solver.function_tolerance = noise;
  solver.parameter_tolerance = noise;
  auto bounds = bounded_parameters(fit.at.layout, records, fit.at.p);
  // The filters of the residuals stand where the fit ended: settle there first.
  const auto settled = minimise(problem, bounds, solver);
  if (!settled) return tl::unexpected(settled.error());
  const ProcessorShare share(settings.kind == Uncertainty::profile ? 0 : 1);
  solver.threads = static_cast<int>(share.threads());
  return intervals({.problem = problem,
                    .parameters = bounds,
                    .p = settled->p,
                    .covariance = fit.covariance,
                    .tolerance = std::max(kEnds, 1e3 * noise),
                    .variances = inflations(fit)},
                   settings, solver);
}

bool near_a_bound(const TrajectoryFit& fit, const std::vector<BoundedParameter>& bounds) {
  const auto& layout = fit.at.layout;
  for (std::size_t k = 0; k < layout.f_group.count + layout.g_group.count; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const double room = fit.solution.p[k] - bounds[k].lower;
    if (fit.solution.bound_active[k] || room < kNear * std::sqrt(fit.covariance(i, i))) return true;
  }
  return false;
}

}  // namespace

Eigen::MatrixXd draws_at_bounds(const TrajectoryFit& fit,
                                const std::vector<PreparedRecord>& records) {
  const auto bounds = bounded_parameters(fit.at.layout, records, fit.at.p);
  if (!near_a_bound(fit, bounds)) return {};
  const auto count = static_cast<Eigen::Index>(bounds.size());
  const auto inflated = inflations(fit);
  double inflation = 0.0;
  double free = 0.0;
  for (std::size_t k = 0; k < inflated.size(); ++k) {
    if (fit.solution.bound_active[k]) continue;
    inflation += inflated[k];
    free += 1.0;
  }
  const Eigen::MatrixXd& j = fit.linear.jacobian;
  const Eigen::MatrixXd plain =
      sandwich(j, j.transpose() * j, std::vector<bool>(bounds.size(), false));
  BoundedNormal law;
  const Eigen::Map<const Eigen::VectorXd> p(fit.solution.p.data(), count);
  law.mean = p - plain * (j.transpose() * fit.linear.residual);
  law.covariance = (free > 0.0 ? inflation / free : 1.0) * plain;
  law.lower.resize(count);
  law.upper.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    law.lower[k] = bounds[static_cast<std::size_t>(k)].lower;
    law.upper[k] = bounds[static_cast<std::size_t>(k)].upper;
  }
  return draws_of(law, p, kDraws, kSeed);
}

Result<Intervals> torsion_intervals(const TrajectoryFit& fit,
                                    const std::vector<PreparedRecord>& records,
                                    const UncertaintySettings& settings,
                                    const SolverSettings& solver,
                                    const IntegratorSettings& integrator) {
  if (settings.kind == Uncertainty::covariance) return Intervals{};
  if (fit.direction == Direction::torque) {
    return of(TorqueResiduals(fit.at.layout, records), fit, records, settings, solver, kRounding);
  }
  TorsionResiduals problem(fit.at.layout, records, integrator);
  if (auto weighed = problem.weigh(fit.at.p); !weighed) return tl::unexpected(weighed.error());
  return of(problem, fit, records, settings, solver, integrator.relative_tolerance);
}

}  // namespace flexspline::estimators
