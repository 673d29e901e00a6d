#include "solvers/ipopt_nlp.hpp"

#include <algorithm>
#include <cmath>

#include <coin/IpTNLP.hpp>

#include "solvers/ipopt_session.hpp"

namespace flexspline::estimators {
namespace {

using Ipopt::Index;
using Ipopt::Number;

constexpr double kUnbounded = 2e19;  // Ipopt's infinity is 1e19

std::span<const double> view(const Number* x, Index n) { return {x, static_cast<std::size_t>(n)}; }
std::span<double> view(Number* x, Index n) { return {x, static_cast<std::size_t>(n)}; }

// Ipopt asks for a matrix once for its places, of which it keeps a copy, and then for its values.
template <class Fill>
bool places_or_values(SparsePattern (SparseNlp::*pattern_of)() const, const SparseNlp& nlp,
                      Index* row, Index* column, Index entries, Number* values, Fill fill) {
  if (values != nullptr) return fill(view(values, entries));
  const SparsePattern pattern = (nlp.*pattern_of)();
  std::ranges::copy(pattern.row, row);
  std::ranges::copy(pattern.column, column);
  return true;
}

class Bridge final : public Ipopt::TNLP {
 public:
  Bridge(const SparseNlp& nlp, std::span<const double> start) : nlp_(nlp), start_(start) {}

  bool get_nlp_info(Index& n, Index& m, Index& in_jacobian, Index& in_hessian,
                    IndexStyleEnum& style) override {
    n = static_cast<Index>(nlp_.variables());
    m = static_cast<Index>(nlp_.constraints());
    in_jacobian = static_cast<Index>(nlp_.jacobian_pattern().size());
    in_hessian = static_cast<Index>(nlp_.hessian_pattern().size());
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* x_l, Number* x_u, Index m, Number* g_l,
                       Number* g_u) override {
    nlp_.bounds(view(x_l, n), view(x_u, n));
    for (Index k = 0; k < n; ++k) {
      x_l[k] = std::max(x_l[k], -kUnbounded);
      x_u[k] = std::min(x_u[k], kUnbounded);
    }
    nlp_.constraint_bounds(view(g_l, m), view(g_u, m));
    for (Index k = 0; k < m; ++k) {
      g_l[k] = std::max(g_l[k], -kUnbounded);
      g_u[k] = std::min(g_u[k], kUnbounded);
    }
    return true;
  }

  bool get_starting_point(Index, bool, Number* x, bool, Number*, Number*, Index, bool,
                          Number*) override {
    std::ranges::copy(start_, x);
    return true;
  }

  bool eval_f(Index n, const Number* x, bool, Number& f) override {
    return nlp_.objective(view(x, n), f) && std::isfinite(f);
  }
  bool eval_grad_f(Index n, const Number* x, bool, Number* g) override {
    return nlp_.gradient(view(x, n), view(g, n));
  }
  bool eval_g(Index n, const Number* x, bool, Index m, Number* c) override {
    ++solution.evaluations;
    return nlp_.constraint(view(x, n), view(c, m));
  }
  bool eval_jac_g(Index n, const Number* x, bool, Index, Index entries, Index* row, Index* column,
                  Number* values) override {
    return places_or_values(&SparseNlp::jacobian_pattern, nlp_, row, column, entries, values,
                            [&](std::span<double> out) { return nlp_.jacobian(view(x, n), out); });
  }
  bool eval_h(Index n, const Number* x, bool, Number factor, Index m, const Number* lambda, bool,
              Index entries, Index* row, Index* column, Number* values) override {
    return places_or_values(&SparseNlp::hessian_pattern, nlp_, row, column, entries, values,
                            [&](std::span<double> out) {
                              return nlp_.hessian(view(x, n), factor, view(lambda, m), out);
                            });
  }

  void finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number*,
                         const Number*, Index m, const Number* c, const Number*, Number f,
                         const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    solution.x.assign(x, x + n);
    solution.objective = f;
    solution.violation = 0.0;
    const auto rows = static_cast<std::size_t>(m);
    std::vector<double> lower(rows);
    std::vector<double> upper(rows);
    nlp_.constraint_bounds(lower, upper);
    for (std::size_t k = 0; k < rows; ++k) {
      solution.violation = std::max({solution.violation, lower[k] - c[k], c[k] - upper[k]});
    }
  }

  bool intermediate_callback(Ipopt::AlgorithmMode, Index iteration, Number, Number, Number, Number,
                             Number, Number, Number, Number, Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    solution.iterations = iteration;
    return true;
  }

  NlpSolution solution;

 private:
  const SparseNlp& nlp_;
  std::span<const double> start_;
};

// Scaling is ours. Debian's MUMPS needs the last two: with its defaults it regularises the dense
// columns of parameters away, or spends minutes ordering them.
void set_options(Ipopt::OptionsList& options, const NlpSettings& settings) {
  options.SetNumericValue("tol", settings.tolerance);
  options.SetNumericValue("constr_viol_tol", settings.tolerance);
  options.SetNumericValue("compl_inf_tol", settings.tolerance);
  options.SetIntegerValue("max_iter", settings.max_iterations);
  options.SetIntegerValue("acceptable_iter", 0);
  options.SetStringValue("nlp_scaling_method", "none");
  options.SetNumericValue("obj_scaling_factor", settings.objective_scale);
  options.SetNumericValue("bound_relax_factor", 0.0);
  options.SetNumericValue("mu_init", settings.barrier_start);
}

Termination termination_of(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
      return Termination::converged;
    case Ipopt::Maximum_Iterations_Exceeded:
      return Termination::iteration_limit;
    case Ipopt::Solved_To_Acceptable_Level:
    case Ipopt::Search_Direction_Becomes_Too_Small:
      return Termination::no_progress;
    default:
      return Termination::failed;
  }
}

}  // namespace

void SparseNlp::constraint_bounds(std::span<double> lower, std::span<double> upper) const {
  std::ranges::fill(lower, 0.0);
  std::ranges::fill(upper, 0.0);
}

Result<NlpSolution> minimise(const SparseNlp& nlp, std::span<const double> start,
                             const NlpSettings& settings) {
  const Ipopt::SmartPtr<Bridge> bridge = new Bridge(nlp, start);
  const auto status = run_ipopt(Ipopt::GetRawPtr(bridge), [&](Ipopt::OptionsList& options) {
    set_options(options, settings);
  });
  if (!status) return tl::unexpected(status.error());
  NlpSolution& solution = bridge->solution;
  solution.termination = termination_of(*status);
  solution.status = words_of(*status);
  if (solution.termination == Termination::failed || solution.x.empty()) {
    return failure(ErrorCode::numerics, "Ipopt gave up: " + solution.status,
                   "start nearer, or widen what the bounds allow");
  }
  return solution;
}

}  // namespace flexspline::estimators
