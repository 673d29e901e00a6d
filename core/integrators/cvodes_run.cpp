#include "integrators/cvodes_run.hpp"

#include <algorithm>

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

namespace flexspline {
namespace {

constexpr long kStepsBetweenCheckpoints = 200;

}  // namespace

CvodesRun::CvodesRun(CvodesProblem& problem, Stepping stepping, double t0,
                     std::span<const double> initial, const CvodesAccuracy& accuracy)
    : problem_(problem), max_steps_(accuracy.max_steps), reached_(t0) {
  expects(initial.size() == problem.rows() * problem.columns() &&
              accuracy.absolute.size() == initial.size(),
          "one initial value and one absolute tolerance an element of the state");
  SUNContext context = nullptr;
  SUNContext_Create(nullptr, &context);
  context_.reset(context);
  state_ = new_vector(initial, context);
  absolute_ = new_vector(accuracy.absolute, context);
  memory_.reset(CVodeCreate(stepping == Stepping::bdf ? CV_BDF : CV_ADAMS, context));
  CVodeSetErrFile(memory(), nullptr);
  CVodeInit(memory(), rate, t0, state_.get());
  CVodeSVtolerances(memory(), accuracy.relative, absolute_.get());
  CVodeSetUserData(memory(), this);
  if (stepping == Stepping::bdf) {
    set_newton();
  } else {
    nonlinear_.reset(SUNNonlinSol_FixedPoint(state_.get(), 0, context));
    CVodeSetNonlinearSolver(memory(), nonlinear_.get());
  }
  if (problem.roots() > 0) {
    CVodeRootInit(memory(), static_cast<int>(problem.roots()), root);
    CVodeSetNoInactiveRootWarn(memory());
  }
}

void CvodesRun::set_newton() {
  matrix_ = new_square_matrix(problem_.rows(), context());
  linear_ = new_block_solver(problem_.rows(), context());
  CVodeSetLinearSolver(memory(), linear_.get(), matrix_.get());
  CVodeSetJacFn(memory(), jacobian);
}

int CvodesRun::rate(double t, N_Vector z, N_Vector zdot, void* self) {
  auto& run = *static_cast<CvodesRun*>(self);
  ++run.evaluations_;
  run.problem_.rate(t, values_of(z).data(), values_of(zdot).data());
  return all_finite(values_of(zdot)) ? 0 : 1;
}

int CvodesRun::jacobian(double t, N_Vector z, N_Vector, SUNMatrix out, void* self, N_Vector,
                        N_Vector, N_Vector) {
  auto block = block_of(out);
  static_cast<CvodesRun*>(self)->problem_.jacobian(t, values_of(z).data(), block);
  return block.allFinite() ? 0 : 1;
}

int CvodesRun::root(double t, N_Vector z, double* values, void* self) {
  static_cast<CvodesRun*>(self)->problem_.root(t, values_of(z).data(), values);
  return 0;
}

void CvodesRun::stop_at(double t) { CVodeSetStopTime(memory(), t); }

void CvodesRun::set_longest_step(double step) { CVodeSetMaxStep(memory(), step); }

int CvodesRun::advance(double t) {
  // CVODES counts its limit anew in each call; 0 and less would mean other things to it.
  if (steps() > max_steps_) return CV_TOO_MUCH_WORK;
  CVodeSetMaxNumSteps(memory(), std::max(1L, max_steps_ - steps()));
  return CVode(memory(), t, state_.get(), &reached_, CV_NORMAL);
}

int CvodesRun::record(double t) {
  CVodeAdjInit(memory(), kStepsBetweenCheckpoints, CV_POLYNOMIAL);
  CVodeSetMaxNumSteps(memory(), max_steps_);
  stop_at(t);
  int checkpoints = 0;
  return CVodeF(memory(), t, state_.get(), &reached_, CV_NORMAL, &checkpoints);
}

void CvodesRun::restart(double t, std::span<const double> z) {
  steps_before_ = steps();
  std::ranges::copy(z, values_of(state_.get()).begin());
  reached_ = t;
  CVodeReInit(memory(), t, state_.get());
}

long CvodesRun::steps() const {
  long steps = 0;
  CVodeGetNumSteps(memory(), &steps);
  return steps_before_ + steps;
}

Error CvodesRun::error(int flag) const {
  return stopped(reached_, values().first(problem_.rows()), flag);
}

}  // namespace flexspline
