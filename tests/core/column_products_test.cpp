// The kernels against Eigen's products, and against sums that are whole numbers.
#include "flexspline/core/column_products.hpp"

#include <gtest/gtest.h>
#include <Eigen/Core>

namespace flexspline {
namespace {

std::vector<InstructionSet> sets_here() {
  std::vector<InstructionSet> sets;
  for (const auto set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (set <= best_instruction_set()) sets.push_back(set);
  }
  return sets;
}

Eigen::MatrixXd product_of(InstructionSet set, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                           bool lower) {
  Eigen::MatrixXd product = Eigen::MatrixXd::Constant(a.cols(), b.cols(), 7.0);
  column_products(set)({a.data(), a.cols()}, {b.data(), b.cols()}, a.rows(), lower, product.data());
  return product;
}

TEST(ColumnProducts, AreEigensForAnyNumberOfRowsAndColumns) {
  for (const InstructionSet set : sets_here()) {
    for (const long rows : {0L, 1L, 7L, 512L, 513L, 1303L}) {
      for (const long high : {0L, 1L, 3L, 4L, 5L, 13L}) {
        for (const long wide : {0L, 1L, 2L, 6L}) {
          const Eigen::MatrixXd a = Eigen::MatrixXd::Random(rows, high);
          const Eigen::MatrixXd b = Eigen::MatrixXd::Random(rows, wide);
          const Eigen::MatrixXd known = a.transpose() * b;
          EXPECT_LT((product_of(set, a, b, false) - known).norm(), 1e-13 * (1.0 + known.norm()))
              << static_cast<int>(set) << ": " << rows << ", " << high << ", " << wide;
        }
      }
    }
  }
}

TEST(ColumnProducts, OfAMatrixWithItselfAreRightBelowTheDiagonal) {
  for (const InstructionSet set : sets_here()) {
    for (const long columns : {1L, 2L, 5L, 9L, 24L}) {
      const Eigen::MatrixXd a = Eigen::MatrixXd::Random(1100, columns);
      const Eigen::MatrixXd apart = product_of(set, a, a, true) - a.transpose() * a;
      EXPECT_LT(Eigen::MatrixXd(apart.triangularView<Eigen::Lower>()).norm(), 1e-11);
    }
  }
}

TEST(ColumnProducts, OfWholeNumbersAreExact) {
  const long rows = 1000;
  Eigen::MatrixXd a(rows, 2);
  a.col(0).setOnes();
  a.col(1) = Eigen::VectorXd::LinSpaced(rows, 1.0, static_cast<double>(rows));
  for (const InstructionSet set : sets_here()) {
    const Eigen::MatrixXd product = product_of(set, a, a, false);
    EXPECT_EQ(product(0, 0), 1000.0);
    EXPECT_EQ(product(0, 1), 500500.0);
    EXPECT_EQ(product(1, 0), 500500.0);
    EXPECT_EQ(product(1, 1), 333833500.0);
  }
}

}  // namespace
}  // namespace flexspline
