#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nonlinearsolver.h>
#include <sundials/sundials_nvector.h>
#include <Eigen/Core>

#include "flexspline/core/error.hpp"
#include "flexspline/core/ode_system.hpp"

namespace flexspline {

/// What CVODES asks of a problem z' = R(t, z). The state z is a matrix of rows x columns stored by
/// columns, and Newton's matrix is the same rows x rows block for every column: a state beside its
/// sensitivities. Second derivatives, which couple the columns, only speed Newton's iteration and
/// are left out.
class CvodesProblem {
 public:
  virtual ~CvodesProblem() = default;
  virtual std::size_t rows() const = 0;
  virtual std::size_t columns() const { return 1; }
  virtual void rate(double t, const double* z, double* zdot) = 0;
  virtual void jacobian(double t, const double* z, Eigen::Map<Eigen::MatrixXd> out) = 0;
  virtual std::size_t roots() const { return 0; }
  virtual void root(double /*t*/, const double* /*z*/, double* /*values*/) {}
};

struct CvodesFree {
  void operator()(void* memory) const;
  void operator()(N_Vector vector) const;
  void operator()(SUNMatrix matrix) const;
  void operator()(SUNLinearSolver solver) const;
  void operator()(SUNNonlinearSolver solver) const;
  void operator()(SUNContext context) const;
};
template <class Pointer>
using CvodesOwned = std::unique_ptr<std::remove_pointer_t<Pointer>, CvodesFree>;

CvodesOwned<N_Vector> new_vector(std::span<const double> values, SUNContext context);
CvodesOwned<SUNMatrix> new_square_matrix(std::size_t rows, SUNContext context);
/// LU of the block, applied to every column of the right-hand side.
CvodesOwned<SUNLinearSolver> new_block_solver(std::size_t rows, SUNContext context);
std::span<double> values_of(N_Vector vector);
Eigen::Map<Eigen::MatrixXd> block_of(SUNMatrix matrix);
bool all_finite(std::span<const double> values);

/// The failure of an integration that CVODES ended with a flag.
Error stopped(double t, std::span<const double> state, int flag);

struct CvodesAccuracy {
  double relative = 1e-8;
  std::vector<double> absolute;  ///< one an element of z
  long max_steps = 200000;       ///< of the whole run
};

/// One integration by CVODES.
class CvodesRun {
 public:
  CvodesRun(CvodesProblem& problem, Stepping stepping, double t0, std::span<const double> initial,
            const CvodesAccuracy& accuracy);
  CvodesRun(const CvodesRun&) = delete;
  CvodesRun& operator=(const CvodesRun&) = delete;

  void stop_at(double t);
  void set_longest_step(double step);
  /// CVODES' flag: negative where it failed, CV_ROOT_RETURN at a root.
  int advance(double t);
  /// Advances and keeps what a backward integration needs.
  int record(double t);
  /// Goes on from another state.
  void restart(double t, std::span<const double> z);

  double reached() const { return reached_; }
  std::span<const double> values() const { return values_of(state_.get()); }
  long steps() const;
  long evaluations() const { return evaluations_; }
  Error error(int flag) const;
  void* memory() const { return memory_.get(); }
  SUNContext context() const { return context_.get(); }

 private:
  static int rate(double t, N_Vector z, N_Vector zdot, void* self);
  static int jacobian(double t, N_Vector z, N_Vector, SUNMatrix out, void* self, N_Vector, N_Vector,
                      N_Vector);
  static int root(double t, N_Vector z, double* values, void* self);
  void set_newton();

  CvodesProblem& problem_;
  long max_steps_;
  CvodesOwned<SUNContext> context_;
  CvodesOwned<N_Vector> state_;
  CvodesOwned<N_Vector> absolute_;
  CvodesOwned<SUNMatrix> matrix_;
  CvodesOwned<SUNLinearSolver> linear_;
  CvodesOwned<SUNNonlinearSolver> nonlinear_;
  std::unique_ptr<void, CvodesFree> memory_;
  double reached_;
  long evaluations_ = 0;
  long steps_before_ = 0;
};

}  // namespace flexspline
