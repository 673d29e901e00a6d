#include "decision/splines.hpp"

#include <algorithm>
#include <cmath>

#include "flexspline/core/cubic_basis.hpp"

namespace flexspline::studies::decision {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd spline(const ArrayXd& x, int intervals) {
  const CubicBasis basis(-1.0, 1.0, static_cast<std::size_t>(intervals));
  MatrixXd columns = MatrixXd::Zero(x.size(), static_cast<Index>(basis.size()));
  for (Index r = 0; r < x.size(); ++r) {
    const auto local = basis.at(std::clamp(x[r], -1.0, 1.0));
    for (std::size_t k = 0; k < 4; ++k) {
      columns(r, static_cast<Index>(local.first + k)) = local.value[k];
    }
  }
  return columns;
}

MatrixXd odd_spline(const ArrayXd& x, int intervals) {
  const MatrixXd all = spline(x, intervals);
  const Index half = all.cols() / 2;
  return all.rightCols(half) - all.leftCols(half).rowwise().reverse();
}

MatrixXd even_spline(const ArrayXd& x, int intervals) {
  const MatrixXd all = spline(x, intervals);
  const Index half = (all.cols() + 1) / 2;
  return all.rightCols(half) + all.leftCols(half).rowwise().reverse();
}

MatrixXd hats(const ArrayXd& x, int count) {
  MatrixXd columns(x.size(), count);
  for (int k = 0; k < count; ++k) {
    const double at = count > 1 ? static_cast<double>(k) / (count - 1) : 0.5;
    columns.col(k) = (1.0 - (x - at).abs() * std::max(count - 1, 1)).max(0.0).matrix();
  }
  return columns;
}

MatrixXd products(const MatrixXd& a, const MatrixXd& b) {
  MatrixXd columns(a.rows(), a.cols() * b.cols());
  for (Index i = 0; i < a.cols(); ++i) {
    for (Index j = 0; j < b.cols(); ++j) {
      columns.col(i * b.cols() + j) = a.col(i).cwiseProduct(b.col(j));
    }
  }
  return columns;
}

ArrayXd compressed(const ArrayXd& x, double core, double range) {
  const double whole = std::asinh(range / core);
  return (x / core).unaryExpr([](double v) { return std::asinh(v); }) / whole;
}

void centre(MatrixXd& columns, const ArrayXd& usable) {
  const double rows = std::max(usable.sum(), 1.0);
  const Eigen::RowVectorXd mean = usable.matrix().transpose() * columns / rows;
  columns.rowwise() -= mean;
}

}  // namespace flexspline::studies::decision
