#pragma once

#include <Eigen/Core>
#include <Eigen/Sparse>

namespace flexspline {

/// Lower half of a symmetric matrix (n, n) that is zero beyond three diagonals of the main one:
/// entry (k, j) is a_(j+k, j).
using Band = Eigen::Matrix<double, 4, Eigen::Dynamic>;

/// Rows that are together in memory: a step of a substitution goes over all columns.
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Of a symmetric matrix; entries beyond the third diagonal are left out.
Band band_of(const Eigen::SparseMatrix<double>& symmetric);

/// L D L^T of a positive definite band, in its own order: there is no fill. A matrix that is not
/// positive definite gives values that are not finite or mean nothing. Of cubic B-splines, where a
/// general sparse solver takes three times as long, and LAPACK's for bands (dpbtrf, dpbtrs) as long
/// as that.
class BandFactors {
 public:
  explicit BandFactors(Band a);
  /// x of A x = right, (n, columns).
  Rows solve(Rows right) const;

 private:
  Band l_;  ///< 1/d in its first row
};

}  // namespace flexspline
