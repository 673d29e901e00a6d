#include "torque_driven/collocation_mesh.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace flexspline::estimators {
namespace {

constexpr std::size_t kMostParts = 32;
constexpr std::size_t kReach = 3;  // intervals before an error that may have brought it

// Replaces the constraints c by the change of motions that makes them vanish: J change = -c. The
// first points of a recording hang together; every other one follows from those before it.
void solve_for_motions(const SparsePattern& pattern, std::span<const double> values,
                       std::size_t parameters, const std::vector<DrivenMesh>& meshes,
                       std::span<double> c) {
  constexpr std::size_t kFirst = DrivenNlp::kStencil - 1;
  std::size_t entry = 0;
  // Calls take(column, value) for every motion in the next row.
  const auto each_in_row = [&](std::size_t row, auto take) {
    for (; entry < pattern.size() && pattern.row[entry] == static_cast<int>(row); ++entry) {
      const auto column = static_cast<std::size_t>(pattern.column[entry]);
      if (column >= parameters) take(column - parameters, values[entry]);
    }
  };
  std::size_t row = 0;
  for (const DrivenMesh& mesh : meshes) {
    const std::size_t base = row;
    Eigen::Matrix<double, kFirst, kFirst> together;
    for (; row < base + kFirst; ++row) {
      each_in_row(row, [&](std::size_t column, double value) {
        together(static_cast<Eigen::Index>(row - base), static_cast<Eigen::Index>(column - base)) =
            value;
      });
    }
    Eigen::Map<Eigen::Matrix<double, kFirst, 1>> first(&c[base]);
    first = (-together.partialPivLu().solve(first)).eval();
    for (; row < base + mesh.points() - 1; ++row) {
      double sum = -c[row];
      double own = 1.0;
      each_in_row(row, [&](std::size_t column, double value) {
        if (column == row) own = value;
        if (column != row) sum -= value * c[column];
      });
      c[row] = sum / own;
    }
  }
}

}  // namespace

CollocationMesh::CollocationMesh(const DrivenProblem& problem) : problem_(problem) {
  for (const auto& one : problem.series) parts_.emplace_back(one.intervals(), 1);
  build();
}

void CollocationMesh::build() {
  meshes_.clear();
  for (std::size_t s = 0; s < parts_.size(); ++s) {
    meshes_.push_back(driven_mesh(problem_.series[s], parts_[s]));
  }
}

std::vector<double> CollocationMesh::packed(std::span<const double> p, const Series& states) const {
  std::vector<double> x(p.begin(), p.end());
  for (std::size_t s = 0; s < parts_.size(); ++s) {
    double before = problem_.series[s].initial;
    for (std::size_t n = 0; n < states[s].size(); ++n) {
      for (std::size_t k = 1; k <= parts_[s][n]; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(parts_[s][n]);
        x.push_back(before + share * (states[s][n] - before));
      }
      before = states[s][n];
    }
  }
  return x;
}

std::vector<double> CollocationMesh::foreseen(std::span<const double> p,
                                              const Series& states) const {
  const DrivenNlp nlp(problem_, meshes_);
  std::vector<double> x = packed(p, states);
  std::vector<double> change(nlp.constraints());
  nlp.constraint(x, change);
  const SparsePattern pattern = nlp.jacobian_pattern();
  std::vector<double> values(pattern.size());
  nlp.jacobian(x, values);
  solve_for_motions(pattern, values, p.size(), meshes_, change);
  for (std::size_t k = 0; k < change.size(); ++k) x[p.size() + k] += change[k];
  return x;
}

Refinement CollocationMesh::divide(std::span<const double> x, const Series& states,
                                   double tolerance) {
  Refinement found;
  std::size_t at = problem_.size();
  for (std::size_t s = 0; s < meshes_.size(); ++s) {
    const auto old = parts_[s];
    for (std::size_t n = 0; n < states[s].size(); ++n) {
      const double motion = x[at + meshes_[s].sample[n + 1] - 1];
      const double error = problem_.series[s].weight[n + 1] * std::abs(motion - states[s][n]);
      found.error = std::max(found.error, error);
      if (error <= tolerance) continue;
      const double factor =
          std::min(std::ceil(std::pow(error / tolerance, 0.25)), 1.0 * kMostParts);
      for (std::size_t k = n - std::min(n, kReach); k <= n; ++k) {
        const std::size_t wanted = static_cast<std::size_t>(factor) * old[k];
        parts_[s][k] = std::max(parts_[s][k], std::min(kMostParts, wanted));
      }
    }
    found.changed = found.changed || parts_[s] != old;
    at += meshes_[s].points() - 1;
  }
  if (found.changed) build();
  return found;
}

}  // namespace flexspline::estimators
