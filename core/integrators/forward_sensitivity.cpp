#include "flexspline/core/forward_sensitivity.hpp"

#include <algorithm>
#include <cmath>

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>

#include "integrators/cvodes_run.hpp"

namespace flexspline {
namespace {

// The state and its sensitivities are one system, z = (y, dy/dp): z0' = F, zk' = dF/dy zk + dF/dpk.
// Its Jacobian is dF/dy on the diagonal and, in its first column, second derivatives of F, which
// only the speed of Newton's iteration needs and which are left out. So each step costs one
// evaluation of the law and vector operations of one array, where CVODES' own forward mode passes
// over an array of vectors of length one.
struct Work {
  const ScalarOde* ode;
  void* memory = nullptr;
  double dfdy = 0.0;  // of the last evaluation
};

int rate(realtype t, N_Vector z, N_Vector zdot, void* data) {
  auto* work = static_cast<Work*>(data);
  const std::size_t count = work->ode->parameters();
  const double* state = N_VGetArrayPointer(z);
  double* out = N_VGetArrayPointer(zdot);
  out[0] = work->ode->rate(t, state[0]);
  if (count == 0) {
    work->dfdy = work->ode->jacobian(t, state[0]);
  } else {
    work->dfdy = work->ode->parameter_derivative(t, state[0], {out + 1, count});
    for (std::size_t k = 1; k <= count; ++k) out[k] += work->dfdy * state[k];
  }
  return std::isfinite(out[0]) && std::isfinite(work->dfdy) ? 0 : 1;
}

SUNLinearSolver_Type solver_type(SUNLinearSolver) { return SUNLINEARSOLVER_MATRIX_EMBEDDED; }

// (1 - gamma dF/dy) x = b.
int solve(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, realtype) {
  const auto* work = static_cast<const Work*>(solver->content);
  realtype gamma = 0.0;
  CVodeGetCurrentGamma(work->memory, &gamma);
  N_VScale(1.0 / (1.0 - gamma * work->dfdy), b, x);
  return 0;
}

int free_solver(SUNLinearSolver solver) {
  solver->content = nullptr;
  SUNLinSolFreeEmpty(solver);
  return 0;
}

// Owns what one integration needs of CVODES.
class Integration {
 public:
  Integration(const ScalarOde& ode, double t0, double initial,
              std::span<const double> initial_sensitivity, const IntegratorSettings& settings)
      : work_{&ode} {
    SUNContext_Create(nullptr, &context_);
    state_ = N_VNew_Serial(static_cast<sunindextype>(1 + ode.parameters()), context_);
    double* z = N_VGetArrayPointer(state_);
    z[0] = initial;
    std::ranges::copy(initial_sensitivity, z + 1);
    work_.memory = CVodeCreate(CV_BDF, context_);
    CVodeSetErrFile(work_.memory, nullptr);
    CVodeInit(work_.memory, rate, t0, state_);
    CVodeSStolerances(work_.memory, settings.relative_tolerance, settings.absolute_tolerance);
    CVodeSetUserData(work_.memory, &work_);
    solver_ = SUNLinSolNewEmpty(context_);
    solver_->ops->gettype = solver_type;
    solver_->ops->solve = solve;
    solver_->ops->free = free_solver;
    solver_->content = &work_;
    CVodeSetLinearSolver(work_.memory, solver_, nullptr);
    CVodeSetMaxNumSteps(work_.memory, settings.max_steps);
  }
  Integration(const Integration&) = delete;
  Integration& operator=(const Integration&) = delete;

  ~Integration() {
    CVodeFree(&work_.memory);
    SUNLinSolFree(solver_);
    N_VDestroy(state_);
    SUNContext_Free(&context_);
  }

  void stop_at(double t) { CVodeSetStopTime(work_.memory, t); }
  int advance(double t) { return CVode(work_.memory, t, state_, &reached_, CV_NORMAL); }
  double reached() const { return reached_; }
  std::span<const double> values() const {
    return {N_VGetArrayPointer(state_), 1 + work_.ode->parameters()};
  }

 private:
  Work work_;
  SUNContext context_ = nullptr;
  N_Vector state_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
  double reached_ = 0.0;
};

}  // namespace

Result<SensitiveTrajectory> integrate(const ScalarOde& ode, std::span<const double> times,
                                      double initial, std::span<const double> initial_sensitivity,
                                      const IntegratorSettings& settings) {
  expects(!times.empty() && initial_sensitivity.size() == ode.parameters(),
          "times, and one initial sensitivity a parameter");
  Integration integration(ode, times.front(), initial, initial_sensitivity, settings);
  integration.stop_at(times.back());
  SensitiveTrajectory result;
  result.state.reserve(times.size());
  result.sensitivity.reserve(times.size() * ode.parameters());
  result.state.push_back(initial);
  result.sensitivity.assign(initial_sensitivity.begin(), initial_sensitivity.end());
  for (std::size_t i = 1; i < times.size(); ++i) {
    const int flag = integration.advance(times[i]);
    const auto z = integration.values();
    if (flag < 0 || !std::isfinite(z[0])) {
      return tl::unexpected(stopped(integration.reached(), z.first(1), flag));
    }
    result.state.push_back(z[0]);
    result.sensitivity.insert(result.sensitivity.end(), z.begin() + 1, z.end());
  }
  return result;
}

}  // namespace flexspline
