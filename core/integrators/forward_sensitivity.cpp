#include "flexspline/core/forward_sensitivity.hpp"

#include <cmath>
#include <cstdlib>
#include <memory>

#include <cvodes/cvodes.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

namespace flexspline {
namespace {

struct Work {
  const ScalarOde* ode;
  std::vector<double> parameter_derivative;
};

int rate(realtype t, N_Vector y, N_Vector ydot, void* data) {
  const auto* work = static_cast<const Work*>(data);
  NV_Ith_S(ydot, 0) = work->ode->rate(t, NV_Ith_S(y, 0));
  return std::isfinite(NV_Ith_S(ydot, 0)) ? 0 : 1;
}

int jacobian(realtype t, N_Vector y, N_Vector, SUNMatrix j, void* data, N_Vector, N_Vector,
             N_Vector) {
  const auto* work = static_cast<const Work*>(data);
  SM_ELEMENT_D(j, 0, 0) = work->ode->jacobian(t, NV_Ith_S(y, 0));
  return 0;
}

int sensitivity_rate(int count, realtype t, N_Vector y, N_Vector, N_Vector* s, N_Vector* sdot,
                     void* data, N_Vector, N_Vector) {
  auto* work = static_cast<Work*>(data);
  const double dfdy =
      work->ode->parameter_derivative(t, NV_Ith_S(y, 0), work->parameter_derivative);
  for (int k = 0; k < count; ++k) {
    NV_Ith_S(sdot[k], 0) =
        dfdy * NV_Ith_S(s[k], 0) + work->parameter_derivative[static_cast<std::size_t>(k)];
  }
  return 0;
}

// Owns what one integration needs of CVODES.
class Integration {
 public:
  Integration(const ScalarOde& ode, double t0, double initial,
              std::span<const double> initial_sensitivity, const IntegratorSettings& settings)
      : work_{&ode, std::vector<double>(ode.parameters())} {
    SUNContext_Create(nullptr, &context_);
    state_ = N_VNew_Serial(1, context_);
    NV_Ith_S(state_, 0) = initial;
    matrix_ = SUNDenseMatrix(1, 1, context_);
    solver_ = SUNLinSol_Dense(state_, matrix_, context_);
    memory_ = CVodeCreate(CV_BDF, context_);
    CVodeSetErrFile(memory_, nullptr);
    CVodeInit(memory_, rate, t0, state_);
    CVodeSStolerances(memory_, settings.relative_tolerance, settings.absolute_tolerance);
    CVodeSetUserData(memory_, &work_);
    CVodeSetLinearSolver(memory_, solver_, matrix_);
    CVodeSetJacFn(memory_, jacobian);
    CVodeSetMaxNumSteps(memory_, settings.max_steps);
    if (ode.parameters() > 0) start_sensitivities(initial_sensitivity, settings);
  }
  Integration(const Integration&) = delete;
  Integration& operator=(const Integration&) = delete;

  ~Integration() {
    CVodeFree(&memory_);
    if (sensitivity_ != nullptr) {
      N_VDestroyVectorArray(sensitivity_, static_cast<int>(work_.ode->parameters()));
    }
    SUNLinSolFree(solver_);
    SUNMatDestroy(matrix_);
    N_VDestroy(state_);
    SUNContext_Free(&context_);
  }

  void stop_at(double t) { CVodeSetStopTime(memory_, t); }

  int advance(double t) { return CVode(memory_, t, state_, &reached_, CV_NORMAL); }

  double state() const { return NV_Ith_S(state_, 0); }
  double reached() const { return reached_; }

  void sensitivities(std::vector<double>& out) {
    if (sensitivity_ == nullptr) return;
    double at = 0.0;
    CVodeGetSens(memory_, &at, sensitivity_);
    for (std::size_t k = 0; k < work_.ode->parameters(); ++k) {
      out.push_back(NV_Ith_S(sensitivity_[k], 0));
    }
  }

 private:
  void start_sensitivities(std::span<const double> initial, const IntegratorSettings& settings) {
    const int count = static_cast<int>(work_.ode->parameters());
    sensitivity_ = N_VCloneVectorArray(count, state_);
    for (int k = 0; k < count; ++k) {
      NV_Ith_S(sensitivity_[k], 0) = initial[static_cast<std::size_t>(k)];
    }
    CVodeSensInit(memory_, count, CV_STAGGERED, sensitivity_rate, sensitivity_);
    std::vector<double> absolute(static_cast<std::size_t>(count), settings.absolute_tolerance);
    CVodeSensSStolerances(memory_, settings.relative_tolerance, absolute.data());
    CVodeSetSensErrCon(memory_, SUNTRUE);
  }

  Work work_;
  SUNContext context_ = nullptr;
  N_Vector state_ = nullptr;
  N_Vector* sensitivity_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
  void* memory_ = nullptr;
  double reached_ = 0.0;
};

std::string reason(int flag) {
  const std::unique_ptr<char, decltype(&std::free)> name(CVodeGetReturnFlagName(flag), &std::free);
  return name ? name.get() : std::to_string(flag);
}

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
    if (flag < 0 || !std::isfinite(integration.state())) {
      return failure(ErrorCode::numerics,
                     fmt::format("the integration stopped at t = {:.6g} s with state {:.6g}: {}",
                                 integration.reached(), integration.state(), reason(flag)),
                     "loosen the tolerance, or look for parameters far from physical ones");
    }
    result.state.push_back(integration.state());
    integration.sensitivities(result.sensitivity);
  }
  return result;
}

}  // namespace flexspline
