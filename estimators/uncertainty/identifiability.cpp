#include "uncertainty/identifiability.hpp"

#include <algorithm>
#include <limits>

#include <Eigen/Dense>

namespace flexspline::estimators {
namespace {

Eigen::MatrixXd scaled_columns(const Eigen::MatrixXd& matrix) {
  std::vector<Eigen::Index> used;
  for (Eigen::Index k = 0; k < matrix.cols(); ++k) {
    if (matrix.col(k).norm() > 0.0) used.push_back(k);
  }
  Eigen::MatrixXd result = matrix(Eigen::all, used);
  result.colwise().normalize();
  return result;
}

// Orthonormal basis of the column space.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& matrix) {
  const Eigen::MatrixXd scaled = scaled_columns(matrix);
  if (scaled.cols() == 0) return scaled;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(scaled);
  qr.setThreshold(1e-9);
  return qr.householderQ() * Eigen::MatrixXd::Identity(scaled.rows(), qr.rank());
}

}  // namespace

double largest_cosine(const Eigen::MatrixXd& of, const Eigen::MatrixXd& rest) {
  const Eigen::MatrixXd product = orthonormal(rest).transpose() * orthonormal(of);
  if (product.size() == 0) return 0.0;
  return std::min(1.0, Eigen::JacobiSVD<Eigen::MatrixXd>(product).singularValues()[0]);
}

double scaled_condition(const Eigen::MatrixXd& jacobian) {
  const Eigen::MatrixXd scaled = scaled_columns(jacobian);
  if (scaled.cols() == 0 || scaled.rows() < scaled.cols()) {
    return std::numeric_limits<double>::infinity();
  }
  // The triangular factor has the singular values of the whole.
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(scaled);
  const Eigen::MatrixXd r = qr.matrixQR().topRows(scaled.cols()).triangularView<Eigen::Upper>();
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(r).singularValues();
  const double smallest = values[values.size() - 1];
  return smallest > 0.0 ? values[0] / smallest : std::numeric_limits<double>::infinity();
}

}  // namespace flexspline::estimators
