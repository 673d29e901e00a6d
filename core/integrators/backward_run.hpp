#pragma once

#include <span>

#include <Eigen/Core>

#include "integrators/cvodes_run.hpp"
#include "integrators/system_duals.hpp"

namespace flexspline {

/// lambda' = -F_y^T lambda back in time, q' = -F_p^T lambda beside it as a quadrature, which costs
/// one evaluation in every direction of p a step.
class Backward {
 public:
  Backward(CvodesRun& forward, SystemDuals& duals, Stepping stepping);

  void start(double t, std::span<const double> lambda, const CvodesAccuracy& accuracy,
             std::span<const double> quadrature_tolerance);
  int advance(double t);
  void jump(double t, std::span<const double> weight);

  std::span<double> lambda() const { return values_of(lambda_.get()); }
  std::span<double> quadrature() const { return values_of(quadrature_.get()); }

 private:
  Eigen::Index states() const { return static_cast<Eigen::Index>(duals_.states()); }
  Eigen::Map<const Eigen::VectorXd> vector(N_Vector v) const {
    return {values_of(v).data(), states()};
  }
  static int rate(double t, N_Vector y, N_Vector lambda, N_Vector out, void* self);
  static int quadrature_rate(double t, N_Vector y, N_Vector lambda, N_Vector out, void* self);
  static int jacobian(double t, N_Vector y, N_Vector, N_Vector, SUNMatrix out, void* self, N_Vector,
                      N_Vector, N_Vector);

  CvodesRun& forward_;
  SystemDuals& duals_;
  Eigen::MatrixXd fy_;
  Eigen::MatrixXd fp_;
  int which_ = 0;
  CvodesOwned<N_Vector> lambda_;
  CvodesOwned<N_Vector> tolerance_;
  CvodesOwned<N_Vector> quadrature_;
  CvodesOwned<N_Vector> quadrature_tolerance_;
  CvodesOwned<SUNMatrix> matrix_;
  CvodesOwned<SUNLinearSolver> linear_;
};

}  // namespace flexspline
