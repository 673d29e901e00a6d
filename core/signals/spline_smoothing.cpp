#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Sparse>

#include "flexspline/core/cubic_basis.hpp"
#include "signals/smoothing.hpp"

namespace flexspline {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
// The systems are banded: any other order of elimination than their own costs more to find than it
// saves.
using BandedSolver = Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>>;

constexpr std::size_t kSamplesPerInterval = 3;
constexpr std::size_t kMostIntervals = 3000;
constexpr int kProbes = 6;

Sparse design(std::span<const double> time, const CubicBasis& basis) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(4 * time.size());
  for (std::size_t i = 0; i < time.size(); ++i) {
    const auto local = basis.at(time[i]);
    for (std::size_t k = 0; k < 4; ++k) {
      entries.emplace_back(static_cast<int>(i), static_cast<int>(local.first + k), local.value[k]);
    }
  }
  Sparse matrix(static_cast<int>(time.size()), static_cast<int>(basis.size()));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Sparse third_differences(int size) {
  std::vector<Eigen::Triplet<double>> entries;
  const double weights[] = {-1.0, 3.0, -3.0, 1.0};
  for (int i = 0; i + 3 < size; ++i) {
    for (int k = 0; k < 4; ++k) entries.emplace_back(i, i + k, weights[k]);
  }
  Sparse matrix(size - 3, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

struct Penalised {
  Eigen::VectorXd coefficients;
  double score = 0.0;
  double freedom = 0.0;
};

// The parts of the penalised equations that are the same for every penalty.
struct Equations {
  Sparse basis;
  Sparse normal;
  Sparse roughness;
  Eigen::VectorXd samples;
  Eigen::MatrixXd right;  // products of the basis with the samples, then with random signs
  BandedSolver solver{};
};

// Generalised cross-validation score of one penalty; the trace by random signs (Hutchinson).
Penalised penalised_fit(Equations& equations, double penalty) {
  equations.solver.factorize(equations.normal + penalty * equations.roughness);
  const Eigen::MatrixXd solved = equations.solver.solve(equations.right);
  Penalised fit;
  fit.coefficients = solved.col(0);
  fit.freedom =
      equations.right.rightCols(kProbes).cwiseProduct(solved.rightCols(kProbes)).sum() / kProbes;
  const double n = static_cast<double>(equations.samples.size());
  const double left = std::max(n - fit.freedom, 1.0);
  const Eigen::VectorXd rest = equations.samples - equations.basis * fit.coefficients;
  fit.score = rest.squaredNorm() * n / (left * left);
  return fit;
}

Eigen::MatrixXd random_signs(Eigen::Index rows) {
  std::mt19937_64 engine(20031);
  Eigen::MatrixXd signs(rows, kProbes);
  for (Eigen::Index i = 0; i < signs.size(); ++i) signs(i) = (engine() & 1) != 0 ? 1.0 : -1.0;
  return signs;
}

}  // namespace

SmoothSignal smooth_by_spline(std::span<const double> time, std::span<const double> samples) {
  const std::size_t n = time.size();
  const std::size_t intervals = std::clamp<std::size_t>(n / kSamplesPerInterval, 4, kMostIntervals);
  const CubicBasis basis(time.front(), time.back(), intervals);
  const Sparse differences = third_differences(static_cast<int>(basis.size()));
  Equations equations{
      .basis = design(time, basis),
      .normal = {},
      .roughness = differences.transpose() * differences,
      .samples = Eigen::Map<const Eigen::VectorXd>(samples.data(), static_cast<Eigen::Index>(n)),
      .right = {}};
  equations.normal = equations.basis.transpose() * equations.basis;
  equations.right.resize(static_cast<Eigen::Index>(basis.size()), 1 + kProbes);
  equations.right.col(0) = equations.basis.transpose() * equations.samples;
  equations.right.rightCols(kProbes) =
      equations.basis.transpose() * random_signs(equations.samples.size());
  equations.solver.analyzePattern(equations.normal + equations.roughness);

  Penalised best;
  best.score = std::numeric_limits<double>::infinity();
  for (double exponent = -6.0; exponent <= 10.0; exponent += 0.5) {
    auto fit = penalised_fit(equations, std::pow(10.0, exponent));
    if (fit.score < best.score) best = std::move(fit);
  }

  SmoothSignal signal{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n), 0.0};
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto local = basis.at(time[i]);
    for (std::size_t k = 0; k < 4; ++k) {
      const double c = best.coefficients[static_cast<Eigen::Index>(local.first + k)];
      signal.value[i] += c * local.value[k];
      signal.rate[i] += c * local.slope[k];
      signal.second[i] += c * local.curvature[k];
    }
    sum += (samples[i] - signal.value[i]) * (samples[i] - signal.value[i]);
  }
  const double left = std::max(static_cast<double>(n) - best.freedom, 1.0);
  signal.noise = std::sqrt(sum / left);
  signal.error.assign(n, signal.noise * std::sqrt(best.freedom / static_cast<double>(n)));
  return signal;
}

}  // namespace flexspline
