// Symmetric band matrices against dense algebra.
#include "signals/banded.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

namespace flexspline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// B^T B + I of a lower band B: positive definite, three diagonals below the main one.
MatrixXd banded(Index n) {
  const MatrixXd dense = MatrixXd::Random(n, n);
  MatrixXd b = MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = std::max<Index>(0, i - 3); j <= i; ++j) b(i, j) = dense(i, j);
  }
  return b.transpose() * b + MatrixXd::Identity(n, n);
}

Band band_in(const MatrixXd& a) { return band_of(Eigen::SparseMatrix<double>(a.sparseView())); }

class Banded : public testing::TestWithParam<Index> {};

// Orders below the width of the band as well.
TEST_P(Banded, SolvesAsDenseAlgebraDoes) {
  std::srand(7);
  const MatrixXd a = banded(GetParam());
  const MatrixXd right = MatrixXd::Random(GetParam(), 5);
  const MatrixXd expected = a.ldlt().solve(right);
  const MatrixXd solved = BandFactors(band_in(a)).solve(right);
  EXPECT_LT((solved - expected).norm(), 1e-12 * expected.norm());
}

INSTANTIATE_TEST_SUITE_P(Orders, Banded, testing::Values(1, 2, 3, 4, 5, 40));

TEST(BandOf, KeepsTheLowerDiagonals) {
  MatrixXd a = MatrixXd::Zero(5, 5);
  for (Index i = 0; i < 5; ++i) {
    for (Index j = 0; j < 5; ++j)
      a(i, j) = std::abs(i - j) <= 3 ? 1.0 + static_cast<double>(10 * i + j) : 0.0;
  }
  const Band band = band_in(a);
  for (Index j = 0; j < 5; ++j) {
    for (Index k = 0; k < 4; ++k) EXPECT_EQ(band(k, j), j + k < 5 ? a(j + k, j) : 0.0);
  }
}

}  // namespace
}  // namespace flexspline
