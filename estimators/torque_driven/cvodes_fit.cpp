#include <algorithm>
#include <cmath>

#include "flexspline/core/in_parallel.hpp"
#include "torque_driven/driven_fit.hpp"
#include "torque_driven/driven_ode.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kRough = 1e-4;             // tolerance on the way to the optimum
constexpr double kRoughDecrease = 1e-3;     // at which it is tightened
constexpr double kStepToTrajectory = 0.02;  // a trajectory errs by more than a step

/// B'B of one recording.
struct Sums {
  Eigen::MatrixXd matrix;
  bool known = false;
};

Sums sums_of(const DrivenProblem& problem, const DrivenSeries& one, std::span<const double> p,
             double tolerance) {
  const auto n = static_cast<Eigen::Index>(p.size());
  const DrivenOde ode(problem, one, p);
  const std::vector<double> still(p.size(), 0.0);
  const auto run = integrate(ode, one.time, one.initial, still, {tolerance, tolerance, 2000000});
  if (!run) return {};
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(one.intervals()), n + 1);
  for (Eigen::Index k = 0; k < rows.rows(); ++k) {
    const auto i = static_cast<std::size_t>(k + 1);
    const Eigen::Map<const Eigen::RowVectorXd> tangent(&run->sensitivity[i * p.size()], n);
    rows.row(k).head(n) = one.weight[i] * tangent;
    rows(k, n) = one.weight[i] * (run->state[i] - one.motion[i]);
  }
  Sums sums{rows.transpose() * rows, true};
  sums.known = sums.matrix.allFinite();
  return sums;
}

}  // namespace

DrivenFit fit_by_cvodes(const DrivenProblem& problem, std::vector<double> p,
                        const DrivenSettings& settings, std::size_t threads) {
  DrivenFit fit{.p = std::move(p), .at = {}};
  const auto n = static_cast<Eigen::Index>(problem.size());
  std::vector<Sums> sums(problem.series.size());
  double tolerance = kRough;
  const NormalEvaluation evaluate =
      [&](std::span<const double> at) -> std::optional<NormalEquations> {
    if (!driven_admissible(problem, at)) return std::nullopt;
    in_parallel(sums.size(), threads, [&](std::size_t s) {
      sums[s] = sums_of(problem, problem.series[s], at, tolerance);
    });
    Eigen::MatrixXd total = Eigen::MatrixXd::Zero(n + 1, n + 1);
    std::vector<double> squares;
    for (std::size_t s = 0; s < sums.size(); ++s) {
      if (!sums[s].known) return std::nullopt;
      total += sums[s].matrix;
      squares.push_back(sums[s].matrix(n, n));
    }
    return NormalEquations{total.topLeftCorner(n, n), total.col(n).head(n), 0.5 * total(n, n),
                           std::move(squares)};
  };
  GaussNewtonSettings newton{.max_iterations = settings.max_iterations, .decrease = kRoughDecrease};
  for (const double wanted : {kRough, kStepToTrajectory * settings.tolerance}) {
    tolerance = wanted;
    auto found = gauss_newton(fit.p, evaluate, newton);
    fit.iterations += found.iterations;
    fit.evaluations += found.evaluations;
    fit.termination = found.termination;
    fit.p = std::move(found.p);
    fit.at = std::move(found.at);
    if (fit.termination == Termination::failed) break;
    // Below what the integration can tell there is nothing to gain.
    newton.decrease = 1e-8;
    newton.first_damping = 1e-6;
  }
  return fit;
}

}  // namespace flexspline::estimators
