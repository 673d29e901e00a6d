#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <cvodes/cvodes.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nvector/nvector_serial.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <Eigen/LU>

#include "integrators/cvodes_run.hpp"

namespace flexspline {
namespace {

using BlockLu = Eigen::PartialPivLU<Eigen::MatrixXd>;

SUNLinearSolver_Type solver_type(SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; }

int factorise(SUNLinearSolver solver, SUNMatrix matrix) {
  auto& lu = *static_cast<BlockLu*>(solver->content);
  lu.compute(block_of(matrix));
  const auto pivots = lu.matrixLU().diagonal();
  return pivots.allFinite() && (pivots.array() != 0.0).all() ? 0 : 1;
}

int solve(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, realtype) {
  const auto& lu = *static_cast<const BlockLu*>(solver->content);
  const auto right = values_of(b);
  const auto columns = static_cast<Eigen::Index>(right.size()) / lu.rows();
  Eigen::Map<Eigen::MatrixXd>(values_of(x).data(), lu.rows(), columns) =
      lu.solve(Eigen::Map<const Eigen::MatrixXd>(right.data(), lu.rows(), columns));
  return 0;
}

int free_solver(SUNLinearSolver solver) {
  delete static_cast<BlockLu*>(solver->content);
  solver->content = nullptr;
  SUNLinSolFreeEmpty(solver);
  return 0;
}

std::string reason(int flag) {
  const std::unique_ptr<char, decltype(&std::free)> name(CVodeGetReturnFlagName(flag), &std::free);
  return name ? name.get() : std::to_string(flag);
}

}  // namespace

void CvodesFree::operator()(void* memory) const { CVodeFree(&memory); }
void CvodesFree::operator()(N_Vector vector) const { N_VDestroy(vector); }
void CvodesFree::operator()(SUNMatrix matrix) const { SUNMatDestroy(matrix); }
void CvodesFree::operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
void CvodesFree::operator()(SUNNonlinearSolver solver) const { SUNNonlinSolFree(solver); }
void CvodesFree::operator()(SUNContext context) const { SUNContext_Free(&context); }

CvodesOwned<N_Vector> new_vector(std::span<const double> values, SUNContext context) {
  CvodesOwned<N_Vector> vector(N_VNew_Serial(static_cast<sunindextype>(values.size()), context));
  std::ranges::copy(values, values_of(vector.get()).begin());
  return vector;
}

CvodesOwned<SUNMatrix> new_square_matrix(std::size_t rows, SUNContext context) {
  const auto n = static_cast<sunindextype>(rows);
  return CvodesOwned<SUNMatrix>(SUNDenseMatrix(n, n, context));
}

CvodesOwned<SUNLinearSolver> new_block_solver(std::size_t rows, SUNContext context) {
  CvodesOwned<SUNLinearSolver> solver(SUNLinSolNewEmpty(context));
  solver->ops->gettype = solver_type;
  solver->ops->setup = factorise;
  solver->ops->solve = solve;
  solver->ops->free = free_solver;
  solver->content = new BlockLu(static_cast<Eigen::Index>(rows));
  return solver;
}

std::span<double> values_of(N_Vector vector) {
  return {NV_DATA_S(vector), static_cast<std::size_t>(NV_LENGTH_S(vector))};
}

Eigen::Map<Eigen::MatrixXd> block_of(SUNMatrix matrix) {
  return {SM_DATA_D(matrix), SM_ROWS_D(matrix), SM_COLUMNS_D(matrix)};
}

bool all_finite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double x) { return std::isfinite(x); });
}

Error stopped(double t, std::span<const double> state, int flag) {
  return Error{ErrorCode::numerics,
               fmt::format("the integration stopped at t = {:.6g} s with state ({:.6g}): {}", t,
                           fmt::join(state, ", "), reason(flag)),
               "loosen the tolerance, or look for parameters far from physical ones",
               {}};
}

}  // namespace flexspline
