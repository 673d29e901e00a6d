#include "diagnosis/unnamed/smooth_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Eigenvalues>

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostSteps = 100;

/// Sums of a regression over whitened rows, in the eigenvectors of its normal matrix.
struct Sums {
  ArrayXd eigen;  ///< of Z'Z
  ArrayXd right;  ///< V'Z'y
  double yy = 0.0;
  double rows = 0.0;
};

struct Variances {
  double noise = 0.0;
  double table = 0.0;
};

double log_evidence(const Sums& s, const Variances& v, double misfit, double squares) {
  const double complexity = (1.0 + v.table / v.noise * s.eigen).log().sum();
  return -0.5 * (s.rows * std::log(v.noise) + misfit / v.noise + squares / v.table + complexity);
}

}  // namespace

std::vector<double> quantile_knots(const ArrayXd& x, const ArrayXd& weight, int count) {
  std::vector<double> sorted;
  for (Index r = 0; r < x.size(); ++r) {
    if (weight[r] > 0.0) sorted.push_back(x[r]);
  }
  std::ranges::sort(sorted);
  std::vector<double> knots;
  if (sorted.empty()) return knots;
  const double apart = 1e-3 * (sorted.back() - sorted.front());
  for (int k = 0; k < count; ++k) {
    const double share = static_cast<double>(k) / (count - 1);
    const double knot = sorted[static_cast<std::size_t>(
        std::lround(share * static_cast<double>(sorted.size() - 1)))];
    if (knots.empty() || knot - knots.back() > apart) knots.push_back(knot);
  }
  return knots;
}

SmoothTable::SmoothTable(std::vector<TableKnots> axes) : axes_(std::move(axes)), size_(1) {
  for (const TableKnots& axis : axes_) size_ *= static_cast<Index>(axis.knots.size());
  rows_.resize(static_cast<std::size_t>(axes_.front().x.size()));
  for (std::size_t a = 0; a < axes_.size(); ++a) {
    const auto& knots = axes_[a].knots;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const double x = axes_[a].x[static_cast<Index>(r)];
      const auto above = std::ranges::upper_bound(knots, x) - knots.begin();
      const auto first = std::clamp<std::ptrdiff_t>(
          above - 1, 0, std::max<std::ptrdiff_t>(0, std::ssize(knots) - 2));
      rows_[r].first[a] = first;
      if (knots.size() < 2) continue;
      const double from = knots[static_cast<std::size_t>(first)];
      const double to = knots[static_cast<std::size_t>(first) + 1];
      rows_[r].upper[a] = std::clamp((x - from) / (to - from), 0.0, 1.0);
    }
  }
}

// Calls visit(knot, share) for the two or four knots about a row.
template <class Visit>
void SmoothTable::visit(Index row, const Visit& visit) const {
  const Local& at = rows_[static_cast<std::size_t>(row)];
  const Index inner = axes_.size() > 1 ? static_cast<Index>(axes_[1].knots.size()) : 1;
  for (Index i = 0; i < 2; ++i) {
    const double outer = i == 0 ? 1.0 - at.upper[0] : at.upper[0];
    if (outer == 0.0) continue;
    for (Index j = 0; j < (axes_.size() > 1 ? 2 : 1); ++j) {
      const double share = outer * (j == 0 ? 1.0 - at.upper[1] : at.upper[1]);
      if (share != 0.0) visit((at.first[0] + i) * inner + at.first[1] + j, share);
    }
  }
}

ArrayXd SmoothTable::at_rows(const VectorXd& u) const {
  ArrayXd value = ArrayXd::Zero(std::ssize(rows_));
  for (Index r = 0; r < value.size(); ++r) {
    visit(r, [&](Index k, double share) { value[r] += share * u[k]; });
  }
  return value;
}

VectorXd SmoothTable::occupation(const ArrayXd& weight) const {
  VectorXd sum = VectorXd::Zero(size_);
  for (Index r = 0; r < weight.size(); ++r) {
    visit(r, [&](Index k, double share) { sum[k] += share * weight[r] * weight[r]; });
  }
  const double all = sum.sum();
  return all > 0.0 ? VectorXd(sum / all) : sum;
}

SmoothTable::Fit SmoothTable::fit(const ArrayXd& y, const ArrayXd& weight, double colour) const {
  MatrixXd normal = MatrixXd::Zero(size_, size_);
  VectorXd right = VectorXd::Zero(size_);
  Sums sums;
  for (Index r = 0; r < y.size(); ++r) {
    if (!(weight[r] > 0.0)) continue;
    const double w = weight[r] * weight[r] / colour;
    sums.rows += 1.0 / colour;
    sums.yy += w * y[r] * y[r];
    std::array<std::pair<Index, double>, 4> near;
    std::size_t count = 0;
    visit(r, [&](Index k, double share) { near[count++] = {k, share}; });
    for (std::size_t i = 0; i < count; ++i) {
      right[near[i].first] += w * near[i].second * y[r];
      for (std::size_t j = 0; j < count; ++j) {
        normal(near[i].first, near[j].first) += w * near[i].second * near[j].second;
      }
    }
  }
  Fit none{VectorXd::Zero(size_), 0.0};
  if (!(sums.yy > 0.0) || sums.rows <= static_cast<double>(size_)) return none;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(normal);
  const MatrixXd& v = solver.eigenvectors();
  sums.eigen = solver.eigenvalues().array().max(0.0);
  sums.right = (v.transpose() * right).array();
  Variances var{sums.yy / sums.rows, 0.0};
  var.table = var.noise / std::max(sums.eigen.mean(), 1e-300);
  const double without = -0.5 * sums.rows * (std::log(var.noise) + 1.0);
  ArrayXd u;
  double gain = 0.0;
  for (int step = 0; step < kMostSteps; ++step) {
    const double ratio = var.noise / var.table;
    u = sums.right / (sums.eigen + ratio);
    const double known = (sums.eigen / (sums.eigen + ratio)).sum();
    const double squares = u.square().sum();
    const double misfit = std::max(
        sums.yy - 2.0 * (u * sums.right).sum() + (u.square() * sums.eigen).sum(), 1e-12 * sums.yy);
    const double now = log_evidence(sums, var, misfit, squares) - without;
    const bool settled = step > 0 && std::abs(now - gain) < 1e-6 * std::max(1.0, std::abs(now));
    gain = now;
    if (settled || !(known > 1e-9) || !(squares > 0.0)) break;
    var = {misfit / (sums.rows - known), squares / known};
  }
  return gain > 0.0 ? Fit{v * u.matrix(), gain} : none;
}

}  // namespace flexspline::studies
