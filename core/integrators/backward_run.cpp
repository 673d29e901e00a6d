#include "integrators/backward_run.hpp"

#include <algorithm>
#include <functional>

#include <cvodes/cvodes.h>

namespace flexspline {

Backward::Backward(CvodesRun& forward, SystemDuals& duals, Stepping stepping)
    : forward_(forward),
      duals_(duals),
      fy_(states(), states()),
      fp_(states(), static_cast<Eigen::Index>(duals.parameters())) {
  CVodeCreateB(forward.memory(), stepping == Stepping::bdf ? CV_BDF : CV_ADAMS, &which_);
}

void Backward::start(double t, std::span<const double> lambda, const CvodesAccuracy& accuracy,
                     std::span<const double> quadrature_tolerance) {
  void* memory = forward_.memory();
  lambda_ = new_vector(lambda, forward_.context());
  tolerance_ = new_vector(accuracy.absolute, forward_.context());
  quadrature_ = new_vector(std::vector<double>(duals_.parameters()), forward_.context());
  quadrature_tolerance_ = new_vector(quadrature_tolerance, forward_.context());
  matrix_ = new_square_matrix(duals_.states(), forward_.context());
  linear_ = new_block_solver(duals_.states(), forward_.context());
  CVodeInitB(memory, which_, rate, t, lambda_.get());
  CVodeSVtolerancesB(memory, which_, accuracy.relative, tolerance_.get());
  CVodeSetUserDataB(memory, which_, this);
  CVodeSetLinearSolverB(memory, which_, linear_.get(), matrix_.get());
  CVodeSetJacFnB(memory, which_, jacobian);
  CVodeSetMaxNumStepsB(memory, which_, accuracy.max_steps);
  CVodeQuadInitB(memory, which_, quadrature_rate, quadrature_.get());
  CVodeQuadSVtolerancesB(memory, which_, accuracy.relative, quadrature_tolerance_.get());
  CVodeSetQuadErrConB(memory, which_, SUNTRUE);
}

int Backward::rate(double t, N_Vector y, N_Vector lambda, N_Vector out, void* data) {
  auto& self = *static_cast<Backward*>(data);
  self.duals_.jacobian(t, values_of(y).data(), {self.fy_.data(), self.states(), self.states()});
  Eigen::Map<Eigen::VectorXd>(values_of(out).data(), self.states()).noalias() =
      -self.fy_.transpose() * self.vector(lambda);
  return all_finite(values_of(out)) ? 0 : 1;
}

int Backward::quadrature_rate(double t, N_Vector y, N_Vector lambda, N_Vector out, void* data) {
  auto& self = *static_cast<Backward*>(data);
  self.duals_.parameter_jacobian(t, values_of(y).data(),
                                 {self.fp_.data(), self.fp_.rows(), self.fp_.cols()});
  Eigen::Map<Eigen::VectorXd>(values_of(out).data(), self.fp_.cols()).noalias() =
      -self.fp_.transpose() * self.vector(lambda);
  return all_finite(values_of(out)) ? 0 : 1;
}

int Backward::jacobian(double t, N_Vector y, N_Vector, N_Vector, SUNMatrix out, void* data,
                       N_Vector, N_Vector, N_Vector) {
  auto& self = *static_cast<Backward*>(data);
  self.duals_.jacobian(t, values_of(y).data(), {self.fy_.data(), self.states(), self.states()});
  block_of(out) = -self.fy_.transpose();
  return self.fy_.allFinite() ? 0 : 1;
}

int Backward::advance(double t) {
  const int flag = CVodeB(forward_.memory(), t, CV_NORMAL);
  if (flag < 0) return flag;
  double reached = t;
  CVodeGetB(forward_.memory(), which_, &reached, lambda_.get());
  return CVodeGetQuadB(forward_.memory(), which_, &reached, quadrature_.get());
}

void Backward::jump(double t, std::span<const double> weight) {
  std::ranges::transform(lambda(), weight, lambda().begin(), std::plus<>{});
  CVodeReInitB(forward_.memory(), which_, t, lambda_.get());
  CVodeQuadReInitB(forward_.memory(), which_, quadrature_.get());
}

}  // namespace flexspline
