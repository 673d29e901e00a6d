// Products of columns as normal equations ask for them, and Eigen's of the same: 4000 rows.
#include <benchmark/benchmark.h>
#include <Eigen/Core>

#include "flexspline/core/column_products.hpp"

namespace flexspline::bench {
namespace {

constexpr Eigen::Index kRows = 4000;

Eigen::MatrixXd columns(benchmark::State& state, int of) {
  return Eigen::MatrixXd::Random(kRows, state.range(of));
}

void gram(benchmark::State& state) {
  const Eigen::MatrixXd a = columns(state, 0);
  Eigen::MatrixXd product(a.cols(), a.cols());
  const ColumnProducts multiply = column_products(best_instruction_set());
  for (auto _ : state) {
    multiply({a.data(), a.cols()}, {a.data(), a.cols()}, kRows, true, product.data());
    benchmark::DoNotOptimize(product.data());
  }
}

void gram_by_eigen(benchmark::State& state) {
  const Eigen::MatrixXd a = columns(state, 0);
  Eigen::MatrixXd product(a.cols(), a.cols());
  for (auto _ : state) {
    product.setZero();
    product.selfadjointView<Eigen::Lower>().rankUpdate(a.transpose());
    benchmark::DoNotOptimize(product.data());
  }
}

void beside(benchmark::State& state) {
  const Eigen::MatrixXd a = columns(state, 0), b = columns(state, 1);
  Eigen::MatrixXd product(a.cols(), b.cols());
  const ColumnProducts multiply = column_products(best_instruction_set());
  for (auto _ : state) {
    multiply({a.data(), a.cols()}, {b.data(), b.cols()}, kRows, false, product.data());
    benchmark::DoNotOptimize(product.data());
  }
}

void beside_by_eigen(benchmark::State& state) {
  const Eigen::MatrixXd a = columns(state, 0), b = columns(state, 1);
  Eigen::MatrixXd product(a.cols(), b.cols());
  for (auto _ : state) {
    product.noalias() = a.transpose() * b;
    benchmark::DoNotOptimize(product.data());
  }
}

BENCHMARK(gram)->Arg(30)->Arg(60)->Unit(benchmark::kMicrosecond);
BENCHMARK(gram_by_eigen)->Arg(30)->Arg(60)->Unit(benchmark::kMicrosecond);
BENCHMARK(beside)->Args({60, 3})->Unit(benchmark::kMicrosecond);
BENCHMARK(beside_by_eigen)->Args({60, 3})->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace flexspline::bench
