#include "solvers/least_squares.hpp"

namespace flexspline::estimators {

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
