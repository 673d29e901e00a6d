#include "torsion/trajectory_fit.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "torsion/torque_residuals.hpp"
#include "torsion/torsion_residuals.hpp"
#include "uncertainty/covariance.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kMaterial = 3.0;  // standard deviations from zero of a term that is kept
constexpr double kSettled = 0.1;   // standard deviations that the minimum may still lie away

// The residuals have unit variance if the noises are what they were measured to be; where more is
// left, by colour or by what the model lacks, the covariance grows with it.
Eigen::MatrixXd covariance_of(const std::vector<PreparedRecord>& records, const Linearisation& at,
                              const std::vector<bool>& bound_active) {
  Eigen::MatrixXd middle = Eigen::MatrixXd::Zero(at.jacobian.cols(), at.jacobian.cols());
  Eigen::Index row = 0;
  for (const auto& one : records) {
    const auto height = static_cast<Eigen::Index>(one.rows.size());
    const Eigen::MatrixXd j = at.jacobian.middleRows(row, height);
    const Eigen::VectorXd r = at.residual.segment(row, height);
    const std::span<const double> series(r.data(), static_cast<std::size_t>(height));
    const double left = r.squaredNorm() / static_cast<double>(height) * long_run_ratio(series);
    middle += std::max(1.0, left) * j.transpose() * j;
    row += height;
  }
  return sandwich(at.jacobian, middle, bound_active);
}

Result<TrajectoryFit> minimised(const LeastSquaresProblem& problem, LinearStart start,
                                const std::vector<PreparedRecord>& records,
                                const SolverSettings& settings, Direction direction) {
  const auto bounds = bounded_parameters(start.layout, records, start.p);
  auto solution = minimise(problem, bounds, settings);
  if (!solution) return tl::unexpected(solution.error());
  Linearisation linear = std::move(solution->at);
  TrajectoryFit fit{std::move(start), std::move(*solution), {}, std::move(linear), direction};
  fit.at.p = fit.solution.p;
  fit.covariance = covariance_of(records, fit.linear, fit.solution.bound_active);
  return fit;
}

Result<TrajectoryFit> fit_torque_once(const LinearStart& start,
                                      const std::vector<PreparedRecord>& records,
                                      const SolverSettings& settings) {
  const TorqueResiduals problem(start.layout, records);
  return minimised(problem, start, records, settings, Direction::torque);
}

FreeTerms significant_terms(const TrajectoryFit& fit) {
  const TorsionLayout& layout = fit.at.layout;
  auto far_from_zero = [&](std::size_t k) {
    const auto i = static_cast<Eigen::Index>(k);
    return std::abs(fit.solution.p[k]) > kMaterial * std::sqrt(fit.covariance(i, i));
  };
  auto keep = [&](const Group& group) { return group.present() && far_from_zero(group.first); };
  FreeTerms free = layout.free_terms();
  free.offset = keep(layout.offset_group);
  free.inertia = keep(layout.inertia_group) && layout.inertia(fit.solution.p) > 0.0;
  free.delay = keep(layout.delay_group);
  if (free.h > kFewestModulationTerms && !far_from_zero(layout.h_group.first + free.h - 1)) {
    --free.h;
  }
  return free;
}

/// What is said of an inertia that is material, and below zero.
std::string refused_inertia(const TrajectoryFit& fit, bool linear) {
  const TorsionLayout& layout = fit.at.layout;
  const double value = layout.inertia(fit.solution.p);
  if (!layout.inertia_group.present() || value >= 0.0) return {};
  const auto i = static_cast<Eigen::Index>(layout.inertia_group.first);
  const double sd = std::sqrt(fit.covariance(i, i));
  if (-value <= kMaterial * sd) return {};
  return fmt::format(
      "inertia is left out: it comes out as {:.3g} +- {:.2g} {}, and none is below zero. Something "
      "that these laws lack goes against the acceleration",
      value, sd, layout.unit(layout.inertia_group.first, !linear));
}

bool same(const FreeTerms& a, const FreeTerms& b) {
  return a.h == b.h && a.offset == b.offset && a.inertia == b.inertia && a.delay == b.delay;
}

}  // namespace

Result<void> add_motion_noise(std::vector<PreparedRecord>& records, const LinearStart& at) {
  const TorqueResiduals problem(at.layout, records);
  for (std::size_t b = 0; b < records.size(); ++b) {
    const auto slopes = problem.motion_slope(b, at.p);
    if (!slopes) return tl::unexpected(slopes.error());
    for (std::size_t r = 0; r < slopes->size(); ++r) {
      records[b].effort_sigma[r] =
          std::hypot(records[b].effort_noise, (*slopes)[r] * records[b].motion_sigma);
    }
  }
  return {};
}

Result<TrajectoryFit> fit_torque(const LinearStart& start,
                                 const std::vector<PreparedRecord>& records,
                                 const SolverSettings& settings) {
  auto fit = fit_torque_once(start, records, settings);
  std::string refused;
  while (fit) {
    const FreeTerms kept = significant_terms(*fit);
    if (same(kept, fit->at.layout.free_terms())) break;
    if (refused.empty()) refused = refused_inertia(*fit, records.front().record.linear);
    fit = fit_torque_once(with_terms(fit->at, kept), records, settings);
  }
  if (fit) fit->refused = std::move(refused);
  return fit;
}

Result<TrajectoryFit> fit_torsion(const TrajectoryFit& from,
                                  const std::vector<PreparedRecord>& records,
                                  const SolverSettings& settings,
                                  const IntegratorSettings& integrator) {
  FreeTerms free = from.at.layout.free_terms();
  free.initial =
      std::ranges::any_of(records, [](const auto& one) { return !one.smooth.steady.has_value(); });
  LinearStart start = with_terms(from.at, free);
  for (std::size_t k = 0; k < start.layout.initial_group.count; ++k) {
    start.p[start.layout.initial_group.first + k] = records[k].smooth.motion.position.front();
  }
  TorsionResiduals problem(start.layout, records, integrator);
  if (auto weighed = problem.weigh(start.p); !weighed) return tl::unexpected(weighed.error());
  // An integration with sensitivities takes other steps than one without: the whole search sees
  // one.
  SolverSettings consistent = settings;
  consistent.slopes_at_trials = true;
  consistent.promise = 0.5 * kSettled * kSettled;
  return minimised(problem, start, records, consistent, Direction::torsion);
}

Leftover leftover(const TrajectoryFit& fit, const std::vector<PreparedRecord>& records) {
  double residual = 0.0;
  double noise = 0.0;
  Eigen::Index row = 0;
  for (const auto& one : records) {
    for (double sigma : one.effort_sigma) {
      residual += std::pow(sigma * fit.linear.residual[row++], 2);
      noise += sigma * sigma;
    }
  }
  const double rows = static_cast<double>(row);
  return {std::sqrt(residual / rows), std::sqrt(noise / rows)};
}

void add_misfit(std::vector<PreparedRecord>& records, const Leftover& left) {
  const double misfit =
      std::sqrt(std::max(0.0, left.residual * left.residual - left.noise * left.noise));
  for (auto& one : records) {
    for (double& sigma : one.effort_sigma) sigma = std::hypot(sigma, misfit);
  }
}

}  // namespace flexspline::estimators
