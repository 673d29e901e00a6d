#include "torque_driven/integration_plan.hpp"

#include <algorithm>
#include <cmath>

#include "flexspline/core/in_parallel.hpp"
#include "torque_driven/driven_ode.hpp"

namespace flexspline::estimators {
namespace {

// The classical formula is stable up to 2.78 on the negative axis and accurate well below.
constexpr double kLongestStep = 1.5;
constexpr double kWantedStep = 1.0;
// An implicit step costs about two explicit ones.
constexpr int kMostExplicitParts = 3;
constexpr int kMostParts = 4096;
constexpr int kMostRounds = 8;

LanePlan plan_for(double stiffness_of_interval) {
  const double parts = std::ceil(stiffness_of_interval / kWantedStep);
  if (parts <= kMostExplicitParts) {
    return {LaneFormula::runge_kutta, std::max(1, static_cast<int>(parts))};
  }
  return {LaneFormula::radau, 1};
}

// Largest width * |d phi'/d phi| along the measured motion; a few samples tell.
double stiffness_along(const DrivenProblem& problem, const DrivenSeries& one,
                       std::span<const double> p) {
  constexpr std::size_t kLooks = 64;
  const std::size_t stride = std::max<std::size_t>(1, one.intervals() / kLooks);
  const DrivenOde ode(problem, one, p);
  double largest = 0.0;
  for (std::size_t n = 0; n < one.intervals(); n += stride) {
    if (!(one.weight[n] > 0.0)) continue;
    largest = std::max(largest, one.width(n) * std::abs(ode.jacobian(one.time[n], one.motion[n])));
  }
  return largest;
}

double order_of(LaneFormula formula) { return formula == LaneFormula::radau ? 5.0 : 4.0; }

}  // namespace

IntegrationPlan::IntegrationPlan(const DrivenProblem& problem, std::span<const double> p,
                                 InstructionSet set, std::size_t threads)
    : problem_(problem), instructions_(set), threads_(threads) {
  plans_.resize(problem.series.size());
  in_parallel(plans_.size(), threads_, [&](std::size_t s) {
    plans_[s] = plan_for(stiffness_along(problem, problem.series[s], p));
  });
}

LaneSet& IntegrationPlan::packed() {
  if (!set_) set_ = std::make_unique<LaneSet>(problem_, plans_, instructions_, threads_);
  return *set_;
}

// What overflowed was stiffer than could be seen.
bool IntegrationPlan::stabilise(const LaneSums& sums) {
  bool changed = false;
  for (std::size_t s = 0; s < plans_.size(); ++s) {
    LanePlan& plan = plans_[s];
    const double stiffness = sums.stiffness[s];
    if (plan.formula == LaneFormula::radau || stiffness <= kLongestStep) continue;
    plan = std::isfinite(stiffness) && std::isfinite(sums.squares[s])
               ? plan_for(stiffness * plan.parts)
               : LanePlan{LaneFormula::radau, 1};
    changed = true;
  }
  return changed;
}

const LaneSums& IntegrationPlan::stable_sums(std::span<const double> p) {
  for (int round = 0;; ++round) {
    const LaneSums& sums = packed().sums(p);
    if (round == kMostRounds || !stabilise(sums)) return sums;
    unpack();
  }
}

std::vector<std::vector<double>> IntegrationPlan::states(std::span<const double> p) {
  return packed().states(p);
}

Refinement IntegrationPlan::refine(std::span<const double> p, double tolerance) {
  const std::vector<double> change = packed().change_by_half_steps(p);
  Refinement found;
  for (std::size_t s = 0; s < plans_.size(); ++s) {
    const double order = order_of(plans_[s].formula);
    const double error = change[s] / (1.0 - std::pow(2.0, -order));
    found.error = std::max(found.error, error);
    if (!(error > tolerance) || plans_[s].parts >= kMostParts) continue;
    const double growth =
        std::ceil(1.1 * plans_[s].parts * std::pow(error / tolerance, 1.0 / order));
    plans_[s].parts = static_cast<int>(std::clamp(growth, plans_[s].parts + 1.0, 1.0 * kMostParts));
    found.changed = true;
  }
  if (found.changed) unpack();
  return found;
}

std::size_t IntegrationPlan::stiff() const {
  return static_cast<std::size_t>(
      std::ranges::count(plans_, LaneFormula::radau, &LanePlan::formula));
}

std::optional<NormalEquations> normal_equations(const DrivenProblem& problem,
                                                const LaneSums& sums) {
  const auto n = static_cast<Eigen::Index>(problem.size());
  if (!std::ranges::all_of(sums.normal, [](double v) { return std::isfinite(v); })) {
    return std::nullopt;
  }
  NormalEquations result{Eigen::MatrixXd(n, n), Eigen::VectorXd(n)};
  std::size_t at = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k <= i; ++k) {
      result.matrix(i, k) = result.matrix(k, i) = sums.normal[at++];
    }
  }
  for (Eigen::Index k = 0; k < n; ++k) result.gradient[k] = sums.normal[at++];
  result.cost = 0.5 * sums.normal[at];
  result.squares = sums.squares;
  return result;
}

NormalEvaluation evaluation_by(const DrivenProblem& problem, IntegrationPlan& plan) {
  return [&](std::span<const double> p) -> std::optional<NormalEquations> {
    if (!driven_admissible(problem, p)) return std::nullopt;
    return normal_equations(problem, plan.stable_sums(p));
  };
}

}  // namespace flexspline::estimators
