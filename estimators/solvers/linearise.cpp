#include <cmath>

#include <fmt/ranges.h>

#include "solvers/least_squares.hpp"

namespace flexspline::estimators {

Error not_a_number(std::span<const double> p) {
  return Error{
      ErrorCode::numerics,
      fmt::format("the residuals at the parameters ({:.6g}) are no numbers", fmt::join(p, ", ")),
      "start nearer, or bound the parameters",
      {}};
}

Result<double> half_sum_of_squares(const LeastSquaresProblem& problem, std::span<const double> p) {
  double cost = 0.0;
  std::vector<double> residual;
  for (std::size_t b = 0; b < problem.blocks(); ++b) {
    residual.resize(problem.residuals(b));
    const auto done = problem.evaluate(b, p, residual, {});
    if (!done) {
      return tl::unexpected(
          in_context(done.error(), fmt::format("parameters ({:.6g})", fmt::join(p, ", "))));
    }
    for (double r : residual) cost += 0.5 * r * r;
  }
  if (!std::isfinite(cost)) return tl::unexpected(not_a_number(p));
  return cost;
}

Result<Linearisation> linearise(const LeastSquaresProblem& problem, std::span<const double> p) {
  Eigen::Index rows = 0;
  for (std::size_t b = 0; b < problem.blocks(); ++b) {
    rows += static_cast<Eigen::Index>(problem.residuals(b));
  }
  Linearisation result{Eigen::VectorXd(rows),
                       Eigen::MatrixXd(rows, static_cast<Eigen::Index>(p.size()))};
  Eigen::Index row = 0;
  for (std::size_t b = 0; b < problem.blocks(); ++b) {
    const std::size_t count = problem.residuals(b);
    const auto height = static_cast<Eigen::Index>(count);
    std::vector<double> residual(count);
    std::vector<double> jacobian(count * p.size());
    const auto done = problem.evaluate(b, p, residual, jacobian);
    if (!done) return tl::unexpected(done.error());
    result.residual.segment(row, height) = Eigen::Map<Eigen::VectorXd>(residual.data(), height);
    result.jacobian.middleRows(row, height) =
        Eigen::Map<RowMajorMatrix>(jacobian.data(), height, static_cast<Eigen::Index>(p.size()));
    row += height;
  }
  return result;
}

}  // namespace flexspline::estimators
