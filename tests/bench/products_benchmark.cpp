// Products of columns as normal equations ask for them, and Eigen's of the same: 4000 rows.
#include <benchmark/benchmark.h>
#include <Eigen/Core>

#include "flexspline/core/column_products.hpp"

namespace flexspline::bench {
namespace {

using Eigen::MatrixXd;

constexpr Eigen::Index kRows = 4000;

/// `lower`: of a matrix with itself, what lies on and below the diagonal.
using Multiply = void (*)(const MatrixXd& a, const MatrixXd& b, bool lower, MatrixXd& product);

void by_kernel(const MatrixXd& a, const MatrixXd& b, bool lower, MatrixXd& product) {
  static const ColumnProducts multiply = column_products(best_instruction_set());
  multiply({a.data(), a.cols()}, {b.data(), b.cols()}, kRows, lower, product.data());
}

void by_eigen(const MatrixXd& a, const MatrixXd& b, bool lower, MatrixXd& product) {
  if (lower) {
    product.setZero();
    product.selfadjointView<Eigen::Lower>().rankUpdate(a.transpose());
  } else {
    product.noalias() = a.transpose() * b;
  }
}

// range(1) columns beside range(0); 0: these with themselves.
void products(benchmark::State& state, Multiply multiply) {
  const bool lower = state.range(1) == 0;
  const MatrixXd a = MatrixXd::Random(kRows, state.range(0));
  const MatrixXd b = lower ? a : MatrixXd::Random(kRows, state.range(1));
  MatrixXd product(a.cols(), b.cols());
  for (auto _ : state) {
    multiply(a, b, lower, product);
    benchmark::DoNotOptimize(product.data());
  }
}

BENCHMARK_CAPTURE(products, by_kernel, by_kernel)
    ->Args({30, 0})
    ->Args({60, 0})
    ->Args({60, 3})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(products, by_eigen, by_eigen)
    ->Args({30, 0})
    ->Args({60, 0})
    ->Args({60, 3})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace flexspline::bench
