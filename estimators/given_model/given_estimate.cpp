#include "given_model/given_estimate.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "flexspline/core/law.hpp"
#include "ode_fit/verdict.hpp"
#include "uncertainty/bands.hpp"
#include "uncertainty/covariance.hpp"
#include "uncertainty/estimate_parts.hpp"

namespace flexspline::estimators {
namespace {

Identifiability judge(const GivenResiduals& problem, const LeastSquaresSolution& solution,
                      const Linearisation& linear, double noise) {
  OdeLayout names;
  std::vector<Eigen::Index> loose;
  for (std::size_t k = 0; k < solution.p.size(); ++k) {
    names.unknowns.push_back({.name = problem.unknowns()[k].name});
    if (!solution.bound_active[k]) loose.push_back(static_cast<Eigen::Index>(k));
  }
  const auto n = static_cast<Eigen::Index>(solution.p.size());
  const Eigen::MatrixXd free = Eigen::MatrixXd::Identity(n, n)(Eigen::all, loose);
  return verdict(names, solution.p, free, linear.jacobian, noise, false);
}

struct Reach {
  double motion = 0.0;
  double rate = 0.0;
};

Reach reach_of(const std::vector<GivenRecord>& records) {
  Reach reach;
  for (const GivenRecord& one : records) {
    for (std::size_t i : one.rows) {
      reach.motion = std::max(reach.motion, std::abs(one.motion.position[i]));
      reach.rate = std::max(reach.rate, std::abs(one.motion.velocity[i]));
    }
  }
  return reach;
}

/// The covariance of a law's coefficients; zero for those that are held, empty where all are.
Eigen::MatrixXd covariance_of(std::string_view law, std::size_t size, const GivenResiduals& problem,
                              const Eigen::MatrixXd& covariance) {
  std::vector<Eigen::Index> from;
  std::vector<Eigen::Index> to;
  for (std::size_t k = 0; k < problem.of_model(); ++k) {
    for (std::size_t c = 0; c < size; ++c) {
      if (problem.unknowns()[k].name != fmt::format("{}[{}]", law, c)) continue;
      from.push_back(static_cast<Eigen::Index>(k));
      to.push_back(static_cast<Eigen::Index>(c));
    }
  }
  if (from.empty()) return {};
  const auto n = static_cast<Eigen::Index>(size);
  Eigen::MatrixXd own = Eigen::MatrixXd::Zero(n, n);
  own(to, to) = covariance(from, from);
  return own;
}

/// Root mean square of a record's residuals as they are, without their weights.
double rmse_of(const GivenRecord& one, const Eigen::VectorXd& residual, Eigen::Index first) {
  double sum = 0.0;
  for (std::size_t i = 0; i < one.rows.size(); ++i) {
    const double plain = residual[first + static_cast<Eigen::Index>(i)] / one.weight[i];
    sum += plain * plain;
  }
  return std::sqrt(sum / static_cast<double>(one.rows.size()));
}

/// Bands of the laws that have free coefficients.
std::vector<FunctionBand> bands_of(const ModelSpec& model, const GivenResiduals& problem,
                                   const Eigen::MatrixXd& covariance, const Reach& reach) {
  std::vector<FunctionBand> bands;
  const auto add = [&](const char* name, const LawSpec& spec, double range) {
    const auto own = covariance_of(name, spec.coefficients.size(), problem, covariance);
    const auto law = make_law(spec);
    if (own.size() > 0 && law) bands.push_back(law_band(name, **law, own, -range, range));
  };
  add("f", model.f, reach.motion);
  add("g_inverse", model.g_inverse, reach.rate);
  add("h", model.h, reach.motion);
  return bands;
}

}  // namespace

Estimate given_estimate(const GivenResiduals& problem, const LeastSquaresSolution& solution,
                        const Linearisation& linear, const std::vector<GivenRecord>& records) {
  const auto rows = static_cast<double>(linear.residual.size());
  const auto loose = std::ranges::count(solution.bound_active, false);
  const double variance =
      linear.residual.squaredNorm() / std::max(1.0, rows - static_cast<double>(loose));
  const Eigen::MatrixXd covariance =
      sandwich(linear.jacobian, score_covariance(problem, linear), solution.bound_active);
  Estimate estimate;
  estimate.estimator = "model_file";
  estimate.model = problem.model_at(solution.p);
  const Reach reach = reach_of(records);
  estimate.model.f.valid_to = reach.motion;
  estimate.model.g_inverse.valid_to = reach.rate;
  for (std::size_t k = 0; k < solution.p.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const GivenParameter& one = problem.unknowns()[k];
    estimate.parameters.push_back(parameter_estimate(one.name, one.unit, solution.p[k],
                                                     covariance(i, i), solution.bound_active[k]));
  }
  estimate.termination = solution.termination;
  estimate.cost = solution.cost;
  estimate.residual = fmt::format("{} along the measured motion, {}",
                                  records.front().record.linear ? "force" : "torque",
                                  records.front().record.linear ? "N" : "Nm");
  Eigen::Index row = 0;
  for (const GivenRecord& one : records) {
    estimate.fits.push_back({one.record.id, Split::train, rmse_of(one, linear.residual, row)});
    row += static_cast<Eigen::Index>(one.rows.size());
  }
  estimate.identifiability = judge(problem, solution, linear, std::sqrt(variance));
  estimate.bands = bands_of(estimate.model, problem, covariance, reach);
  estimate.evaluations = solution.evaluations;
  return estimate;
}

}  // namespace flexspline::estimators
