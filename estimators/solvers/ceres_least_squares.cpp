#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include <ceres/ceres.h>

#include "solvers/least_squares.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kAtBound = 1e-6;  // distance from a bound, in scales, that counts as on it
constexpr int kRounds = 4;         // of letting go of bounds
constexpr double kFree = 100.0;    // trust radius from which a step is nearly Gauss's and Newton's

// What the blocks tell beside their values: how often they ran, and why one last failed.
struct Log {
  std::atomic<long> evaluations{0};
  std::mutex mutex;
  std::string last_failure;
};

// Keeps what every block last gave with derivatives: Ceres asks again where it begins, where a
// trial is accepted, and where it ended. eager: derivatives are found at trials, too.
class Remembering final : public LeastSquaresProblem {
 public:
  Remembering(const LeastSquaresProblem& problem, bool eager, Log& log)
      : problem_(problem), eager_(eager), log_(log), last_(problem.blocks()) {}

  std::size_t blocks() const override { return problem_.blocks(); }
  std::size_t residuals(std::size_t block) const override { return problem_.residuals(block); }

  Result<void> evaluate(std::size_t block, std::span<const double> p, std::span<double> residual,
                        std::span<double> jacobian) const override {
    if (jacobian.empty() && !eager_) return problem_evaluate(block, p, residual, {});
    Last& last = last_[block];
    if (!std::ranges::equal(last.p, p)) {
      last.p.clear();
      last.residual.resize(residual.size());
      last.jacobian.resize(residual.size() * p.size());
      if (auto done = problem_evaluate(block, p, last.residual, last.jacobian); !done) return done;
      last.p.assign(p.begin(), p.end());
    }
    std::ranges::copy(last.residual, residual.begin());
    if (!jacobian.empty()) std::ranges::copy(last.jacobian, jacobian.begin());
    return {};
  }

 private:
  struct Last {
    std::vector<double> p, residual, jacobian;
  };

  Result<void> problem_evaluate(std::size_t block, std::span<const double> p,
                                std::span<double> residual, std::span<double> jacobian) const {
    ++log_.evaluations;
    auto done = problem_.evaluate(block, p, residual, jacobian);
    if (!done) {
      const std::lock_guard lock(log_.mutex);
      log_.last_failure = done.error().message();
    }
    return done;
  }

  const LeastSquaresProblem& problem_;
  bool eager_;
  Log& log_;
  mutable std::vector<Last> last_;  // Ceres evaluates a block once at a time
};

class Block final : public ceres::CostFunction {
 public:
  Block(const LeastSquaresProblem& problem, std::size_t index,
        std::span<const BoundedParameter> parameters)
      : problem_(problem), index_(index), parameters_(parameters) {
    set_num_residuals(static_cast<int>(problem.residuals(index)));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(parameters.size()));
  }

  bool Evaluate(double const* const* scaled, double* residuals, double** jacobians) const override {
    const std::size_t count = parameters_.size();
    const auto rows = static_cast<std::size_t>(num_residuals());
    std::vector<double> p(count);
    for (std::size_t k = 0; k < count; ++k) p[k] = scaled[0][k] * parameters_[k].scale;
    double* wanted = jacobians != nullptr ? jacobians[0] : nullptr;
    const std::span<double> jacobian{wanted, wanted != nullptr ? rows * count : 0};
    if (!problem_.evaluate(index_, p, {residuals, rows}, jacobian)) return false;
    for (std::size_t i = 0; i < jacobian.size(); ++i) jacobian[i] *= parameters_[i % count].scale;
    return true;
  }

 private:
  const LeastSquaresProblem& problem_;
  std::size_t index_;
  std::span<const BoundedParameter> parameters_;
};

Termination termination_of(const ceres::Solver::Summary& summary) {
  switch (summary.termination_type) {
    case ceres::CONVERGENCE:
    case ceres::USER_SUCCESS:
      return Termination::converged;
    case ceres::NO_CONVERGENCE:
      return Termination::iteration_limit;
    default:
      return Termination::failed;
  }
}

ceres::Solver::Options solver_options(const SolverSettings& settings) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = settings.max_iterations;
  options.function_tolerance = settings.function_tolerance;
  options.parameter_tolerance = settings.parameter_tolerance;
  options.gradient_tolerance = settings.gradient_tolerance;
  options.initial_trust_region_radius = settings.trust_radius;
  options.min_lm_diagonal = settings.damping_floor;
  options.num_threads = settings.threads;
  options.max_num_line_search_step_size_iterations = 0;
  options.logging_type = ceres::SILENT;
  return options;
}

// Ends a solve where a step that is hardly damped promises too little.
class Promise final : public ceres::IterationCallback {
 public:
  explicit Promise(double least) : least_(least) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
    if (step.iteration == 0 || step.trust_region_radius < kFree) return ceres::SOLVER_CONTINUE;
    const double promised = step.cost_change / step.relative_decrease;
    return promised < least_ ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  double least_;
};

std::vector<double> unscaled(std::span<const BoundedParameter> parameters,
                             const std::vector<double>& x) {
  std::vector<double> p(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) p[k] = x[k] * parameters[k].scale;
  return p;
}

// Gradient J'r in the solver's scaled parameters.
std::vector<double> scaled_gradient(const Linearisation& at,
                                    std::span<const BoundedParameter> parameters) {
  const Eigen::VectorXd gradient = at.jacobian.transpose() * at.residual;
  std::vector<double> result(parameters.size());
  for (std::size_t k = 0; k < result.size(); ++k) {
    result[k] = gradient[static_cast<Eigen::Index>(k)] * parameters[k].scale;
  }
  return result;
}

// Parameters on a bound that the gradient pushes against it.
std::vector<int> held_on_bounds(std::span<const BoundedParameter> parameters,
                                const std::vector<double>& x, const std::vector<double>& gradient) {
  std::vector<int> held;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const bool low = x[k] - parameters[k].lower / parameters[k].scale < kAtBound;
    const bool high = parameters[k].upper / parameters[k].scale - x[k] < kAtBound;
    if ((low && gradient[k] > 0.0) || (high && gradient[k] < 0.0)) {
      held.push_back(static_cast<int>(k));
    }
  }
  return held;
}

ceres::Solver::Summary solve_holding(const LeastSquaresProblem& problem,
                                     std::span<const BoundedParameter> parameters,
                                     const std::vector<int>& held, const SolverSettings& settings,
                                     std::vector<double>& x) {
  ceres::Problem ceres_problem;
  for (std::size_t b = 0; b < problem.blocks(); ++b) {
    ceres_problem.AddResidualBlock(new Block(problem, b, parameters), nullptr, x.data());
  }
  for (std::size_t k = 0; k < x.size(); ++k) {
    const auto& parameter = parameters[k];
    const int index = static_cast<int>(k);
    if (std::isfinite(parameter.lower)) {
      ceres_problem.SetParameterLowerBound(x.data(), index, parameter.lower / parameter.scale);
    }
    if (std::isfinite(parameter.upper)) {
      ceres_problem.SetParameterUpperBound(x.data(), index, parameter.upper / parameter.scale);
    }
  }
  if (!held.empty()) {
    ceres_problem.SetManifold(x.data(),
                              new ceres::SubsetManifold(static_cast<int>(x.size()), held));
  }
  auto options = solver_options(settings);
  Promise promise(settings.promise);
  if (settings.promise > 0.0) options.callbacks.push_back(&promise);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres_problem, &summary);
  return summary;
}

}  // namespace

// Ceres projects onto bounds, which zigzags along those that are active; so what the start holds on
// a bound is held there, and let go where the gradient then says so.
Result<LeastSquaresSolution> minimise(const LeastSquaresProblem& asked,
                                      std::span<const BoundedParameter> parameters,
                                      const SolverSettings& settings) {
  std::vector<double> x(parameters.size());
  for (std::size_t k = 0; k < x.size(); ++k) {
    const auto& parameter = parameters[k];
    x[k] = std::clamp(parameter.start, parameter.lower, parameter.upper) / parameter.scale;
  }
  Log log;
  const Remembering problem(asked, settings.slopes_at_trials, log);
  LeastSquaresSolution solution;
  std::vector<int> held;
  for (int round = 0;; ++round) {
    auto at = linearise(problem, unscaled(parameters, x));
    if (!at) return tl::unexpected(in_context(at.error(), "the start of the fit"));
    auto now_held = held_on_bounds(parameters, x, scaled_gradient(*at, parameters));
    solution.at = std::move(*at);
    if (round > 0 && now_held == held) break;
    if (round == kRounds) {
      solution.termination = Termination::iteration_limit;
      break;
    }
    held = std::move(now_held);
    const auto summary = solve_holding(problem, parameters, held, settings, x);
    if (summary.termination_type == ceres::FAILURE) {
      return failure(ErrorCode::numerics,
                     "the fit could not go on: " +
                         (log.last_failure.empty() ? summary.message : log.last_failure),
                     "start nearer, or leave the recording out");
    }
    solution.termination = termination_of(summary);
    solution.cost = summary.final_cost;
    solution.iterations += static_cast<int>(summary.iterations.size());
  }
  solution.evaluations = log.evaluations;
  solution.p = unscaled(parameters, x);
  for (std::size_t k = 0; k < x.size(); ++k) {
    const auto& parameter = parameters[k];
    solution.bound_active.push_back(x[k] - parameter.lower / parameter.scale < kAtBound ||
                                    parameter.upper / parameter.scale - x[k] < kAtBound);
  }
  return solution;
}

}  // namespace flexspline::estimators
