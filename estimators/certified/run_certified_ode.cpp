#include <algorithm>
#include <chrono>
#include <cmath>

#include "flexspline/estimators/certified.hpp"
#include "flexspline/estimators/certified_ode.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kMostOffset = 0.01;

void judge(const OdeFit& fit, CertifiedOdeRun& run) {
  const auto& certified = run.problem->parameters;
  run.cost_digits = correct_digits(run.sum_of_squares, run.problem->sum_of_squares);
  run.worst_digits = kMostDigits;
  run.worst_offset = 0.0;
  for (std::size_t k = 0; k < certified.size(); ++k) {
    const auto& p = fit.parameters[k];
    run.parameter_digits.push_back(correct_digits(p.value, certified[k]));
    run.worst_digits = std::min(run.worst_digits, run.parameter_digits.back());
    const double off = std::abs(p.value - certified[k]);
    const double offset = p.bound_active ? (off == 0.0 ? 0.0 : kNotComputed) : off / p.std;
    run.worst_offset = std::isnan(offset) ? offset : std::max(run.worst_offset, offset);
  }
}

}  // namespace

bool CertifiedOdeRun::passed() const {
  return termination == Termination::converged && cost_digits >= kRequiredOdeDigits &&
         worst_offset <= kMostOffset;
}

CertifiedOdeRun run_certified(const CertifiedOde& problem, OdeFitMethod method) {
  CertifiedOdeRun run{.problem = &problem, .method = method};
  const auto began = std::chrono::steady_clock::now();
  const auto fit = fit_ode(problem.problem, method);
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  if (!fit) {
    run.termination = Termination::failed;
    run.failure = fit.error().message();
    return run;
  }
  run.termination = fit->termination;
  run.iterations = fit->iterations;
  for (std::size_t k = 0; k < problem.parameters.size(); ++k) {
    run.parameters.push_back(fit->parameters[k].value);
  }
  run.sum_of_squares = 2.0 * fit->cost;
  judge(*fit, run);
  return run;
}

}  // namespace flexspline::estimators
