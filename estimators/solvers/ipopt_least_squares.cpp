#include <algorithm>
#include <cmath>
#include <utility>

#include "solvers/damping.hpp"
#include "solvers/ipopt_session.hpp"
#include "solvers/least_squares.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kAtBound = 1e-6;      // as in the Ceres backend: in scales
constexpr double kNoBound = 1e20;      // what Ipopt takes for infinity
constexpr double kRounding = 2e-15;    // relative falls of the cost below this are noise
constexpr double kExact = 1e-30;       // of the start's cost: residuals are down to rounding
constexpr double kGap = 1e-17;         // of the start's cost, that the barrier may hide
constexpr int kStalls = 3;             // iterations in a row without a fall
constexpr double kLeastCost = 1e-290;  // against division by a start that fits exactly

/// min |r(p)|^2 / |r(start)|^2 over p / scale, so that no tolerance depends on units.
class LeastSquaresNlp final : public Ipopt::TNLP {
 public:
  LeastSquaresNlp(const LeastSquaresProblem& problem, std::span<const BoundedParameter> parameters,
                  const SolverSettings& settings, double start_cost)
      : problem_(problem),
        parameters_(parameters),
        settings_(settings),
        unit_(std::max(start_cost, kLeastCost)),
        damping_(1.0 / settings.trust_radius, settings.damping_floor) {}

  LeastSquaresSolution solution;
  std::string last_failure;

  bool get_nlp_info(Ipopt::Index& n, Ipopt::Index& m, Ipopt::Index& nonzeros_jacobian,
                    Ipopt::Index& nonzeros_hessian, IndexStyleEnum& style) override {
    n = size();
    m = 0;
    nonzeros_jacobian = 0;
    nonzeros_hessian = n * (n + 1) / 2;
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Ipopt::Index n, double* lower, double* upper, Ipopt::Index, double*,
                       double*) override {
    for (Ipopt::Index k = 0; k < n; ++k) {
      const auto& one = parameter(k);
      lower[k] = std::isfinite(one.lower) ? one.lower / one.scale : -kNoBound;
      upper[k] = std::isfinite(one.upper) ? one.upper / one.scale : kNoBound;
      bounds_ += (lower[k] > -kNoBound) + (upper[k] < kNoBound);
    }
    return true;
  }

  bool get_starting_point(Ipopt::Index n, bool, double* x, bool, double*, double*, Ipopt::Index,
                          bool, double*) override {
    for (Ipopt::Index k = 0; k < n; ++k) {
      const auto& one = parameter(k);
      x[k] = std::clamp(one.start, one.lower, one.upper) / one.scale;
    }
    return true;
  }

  bool eval_f(Ipopt::Index, const double* x, bool, double& value) override {
    const auto cost = half_sum_of_squares(problem_, natural(x));
    ++solution.evaluations;
    if (!cost) return note(cost.error());
    value = *cost / unit_;
    return true;
  }

  bool eval_grad_f(Ipopt::Index, const double* x, bool, double* gradient) override {
    if (!linearise_at(x)) return false;
    Eigen::Map<Eigen::VectorXd>(gradient, size()) =
        linear_.jacobian.transpose() * linear_.residual / unit_;
    return true;
  }

  bool eval_g(Ipopt::Index, const double*, bool, Ipopt::Index, double*) override { return true; }
  bool eval_jac_g(Ipopt::Index, const double*, bool, Ipopt::Index, Ipopt::Index, Ipopt::Index*,
                  Ipopt::Index*, double*) override {
    return true;
  }

  bool eval_h(Ipopt::Index n, const double* x, bool, double factor, Ipopt::Index, const double*,
              bool, Ipopt::Index, Ipopt::Index* rows, Ipopt::Index* columns,
              double* values) override {
    if (values == nullptr) {
      for (Ipopt::Index row = 0, k = 0; row < n; ++row) {
        for (Ipopt::Index column = 0; column <= row; ++column, ++k) {
          rows[k] = row;
          columns[k] = column;
        }
      }
      return true;
    }
    if (!linearise_at(x)) return false;
    Eigen::MatrixXd hessian = linear_.jacobian.transpose() * linear_.jacobian;
    hessian.diagonal() += damping_.at(linear_, Eigen::Map<const Eigen::VectorXd>(x, n));
    hessian *= factor / unit_;
    for (Ipopt::Index row = 0, k = 0; row < n; ++row) {
      for (Ipopt::Index column = 0; column <= row; ++column) values[k++] = hessian(row, column);
    }
    return true;
  }

  // Ipopt's own test knows only gradients. Like Ceres this stops where the cost no longer falls,
  // once the barrier, which is off by mu a bound, cannot be what hides a fall.
  bool intermediate_callback(Ipopt::AlgorithmMode, Ipopt::Index iteration, double value, double,
                             double, double mu, double, double, double, double, Ipopt::Index,
                             const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    solution.iterations = iteration;
    const double fall = std::abs(std::exchange(last_value_, value) - value);
    const double least = std::max(settings_.function_tolerance, kRounding) * value;
    const bool stalls = fall <= least && bounds_ * mu <= std::max(least, kGap);
    stalled_ = iteration > 0 && stalls ? stalled_ + 1 : 0;
    if (value <= kExact) return false;
    return stalled_ < kStalls;
  }

  void finalize_solution(Ipopt::SolverReturn, Ipopt::Index, const double* x, const double*,
                         const double*, Ipopt::Index, const double*, const double*, double value,
                         const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    solution.p = natural(x);
    solution.cost = value * unit_;
    for (std::size_t k = 0; k < parameters_.size(); ++k) {
      const auto& one = parameters_[k];
      const double nearest = std::min(solution.p[k] - one.lower, one.upper - solution.p[k]);
      solution.bound_active.push_back(nearest / one.scale < kAtBound);
    }
  }

 private:
  Ipopt::Index size() const { return static_cast<Ipopt::Index>(parameters_.size()); }
  const BoundedParameter& parameter(Ipopt::Index k) const {
    return parameters_[static_cast<std::size_t>(k)];
  }

  std::vector<double> natural(const double* x) const {
    std::vector<double> p(parameters_.size());
    for (std::size_t k = 0; k < p.size(); ++k) p[k] = x[k] * parameters_[k].scale;
    return p;
  }

  bool note(const Error& error) {
    last_failure = error.message();
    return false;
  }

  // The Jacobian in scaled parameters, kept for the Hessian at the same point.
  bool linearise_at(const double* x) {
    auto p = natural(x);
    if (p == linearised_at_) return true;
    auto linear = linearise(problem_, p);
    ++solution.evaluations;
    if (!linear) return note(linear.error());
    for (Ipopt::Index k = 0; k < size(); ++k) linear->jacobian.col(k) *= parameter(k).scale;
    if (!linear->jacobian.allFinite() || !linear->residual.allFinite()) {
      return note(not_a_number(p));
    }
    linear_ = std::move(*linear);
    linearised_at_ = std::move(p);
    return true;
  }

  const LeastSquaresProblem& problem_;
  std::span<const BoundedParameter> parameters_;
  SolverSettings settings_;
  double unit_;
  int bounds_ = 0;
  int stalled_ = 0;
  double last_value_ = kNotComputed;
  std::vector<double> linearised_at_;
  Linearisation linear_;
  Damping damping_;
};

Termination termination_of(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
    case Ipopt::Solved_To_Acceptable_Level:
    case Ipopt::Search_Direction_Becomes_Too_Small:
    case Ipopt::User_Requested_Stop:
      return Termination::converged;
    case Ipopt::Maximum_Iterations_Exceeded:
      return Termination::iteration_limit;
    case Ipopt::Restoration_Failed:
    case Ipopt::Error_In_Step_Computation:
      return Termination::no_progress;
    default:
      return Termination::failed;
  }
}

void configure(const SolverSettings& settings, Ipopt::OptionsList& options) {
  options.SetIntegerValue("max_iter", settings.max_iterations);
  options.SetNumericValue("tol", settings.gradient_tolerance);
  options.SetIntegerValue("acceptable_iter", 0);
  options.SetStringValue("nlp_scaling_method", "none");
  options.SetNumericValue("bound_relax_factor", 0.0);
  options.SetStringValue("hessian_approximation", settings.curvature == Curvature::limited_memory
                                                      ? "limited-memory"
                                                      : "exact");
}

}  // namespace

Result<LeastSquaresSolution> minimise_ipopt(const LeastSquaresProblem& problem,
                                            std::span<const BoundedParameter> parameters,
                                            const SolverSettings& settings) {
  std::vector<double> start;
  for (const auto& one : parameters) start.push_back(std::clamp(one.start, one.lower, one.upper));
  const auto cost = half_sum_of_squares(problem, start);
  if (!cost) return tl::unexpected(in_context(cost.error(), "the start of the fit"));
  auto* nlp = new LeastSquaresNlp(problem, parameters, settings, *cost);
  const Ipopt::SmartPtr<Ipopt::TNLP> kept = nlp;
  const auto status =
      run_ipopt(kept, [&](Ipopt::OptionsList& options) { configure(settings, options); });
  if (!status) return tl::unexpected(status.error());
  nlp->solution.termination = termination_of(*status);
  if (nlp->solution.termination == Termination::failed || nlp->solution.p.empty()) {
    return failure(ErrorCode::numerics,
                   "the fit could not go on: " +
                       (nlp->last_failure.empty() ? words_of(*status) : nlp->last_failure),
                   "start nearer, or leave the recording out");
  }
  return nlp->solution;
}

}  // namespace flexspline::estimators
