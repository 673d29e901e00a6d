#include "torque_driven/driven_nlp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexspline::estimators {
namespace {

SparsePattern empty_pattern(std::size_t entries) {
  SparsePattern pattern;
  pattern.row.reserve(entries);
  pattern.column.reserve(entries);
  return pattern;
}

// Whether two stencils are the same but for where they lie, and for rounding.
bool alike(std::span<const double> a, std::span<const double> b) {
  constexpr double kRounding = 1e-11;
  const double width = a.back() - a.front();
  for (std::size_t k = 0; k + 1 < a.size(); ++k) {
    if (std::abs((a.back() - a[k]) - (b.back() - b[k])) > kRounding * width) return false;
  }
  return true;
}

}  // namespace

DrivenMesh driven_mesh(const DrivenSeries& series, std::span<const std::size_t> parts) {
  DrivenMesh mesh{.time = {series.time.front()}, .torque = {series.torque.front()}, .sample = {0}};
  for (std::size_t n = 0; n < series.intervals(); ++n) {
    for (std::size_t k = 1; k <= parts[n]; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(parts[n]);
      mesh.time.push_back(series.time[n] + share * series.width(n));
      mesh.torque.push_back(series.torque_at(n, share));
    }
    mesh.sample.push_back(mesh.points() - 1);
  }
  return mesh;
}

// The derivative of Lagrange's polynomials.
std::vector<double> derivative_weights(std::span<const double> points, double at) {
  std::vector<double> weights(points.size(), 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (k == i) continue;
      double product = 1.0 / (points[i] - points[k]);
      for (std::size_t m = 0; m < points.size(); ++m) {
        if (m != i && m != k) product *= (at - points[m]) / (points[i] - points[m]);
      }
      weights[i] += product;
    }
  }
  return weights;
}

DrivenNlp::DrivenNlp(const DrivenProblem& problem, const std::vector<DrivenMesh>& meshes)
    : problem_(problem), parameters_(problem.size()) {
  std::size_t count = 0;
  for (const DrivenMesh& mesh : meshes) count += mesh.points() - 1;
  points_.reserve(count);
  for (std::size_t s = 0; s < meshes.size(); ++s) add(problem.series[s], meshes[s]);
}

void DrivenNlp::add(const DrivenSeries& series, const DrivenMesh& mesh) {
  const std::size_t base = points_.size();
  std::size_t sample = 1;
  std::size_t told = 0;  // the last point with weights of its own
  for (std::size_t i = 1; i < mesh.points(); ++i) {
    const std::size_t first = i < kStencil ? 0 : i + 1 - kStencil;
    const std::span<const double> stencil(&mesh.time[first], kStencil);
    Point point{.width = mesh.time[i] - mesh.time[i - 1], .torque = mesh.torque[i]};
    if (i == mesh.sample[sample]) {
      point.measured = series.motion[sample];
      point.weight = series.weight[sample];
      ++sample;
    }
    const bool at_start = first == 0;
    point.first = base + (at_start ? 0 : first - 1);
    point.count = at_start ? kStencil - 1 : kStencil;
    if (!at_start && i > kStencil && alike(stencil, {&mesh.time[told - kStencil + 1], kStencil})) {
      point.weights = points_[base + told - 1].weights;
    } else {
      auto weights = derivative_weights(stencil, mesh.time[i]);
      for (double& w : weights) w *= point.width;
      if (at_start) point.known = weights.front() * series.initial;
      point.weights = weights_.size();
      weights_.insert(weights_.end(), weights.begin() + (at_start ? 1 : 0), weights.end());
      told = i;
    }
    points_.push_back(point);
  }
}

void DrivenNlp::bounds(std::span<double> lower, std::span<double> upper) const {
  std::ranges::fill(lower, -std::numeric_limits<double>::infinity());
  std::ranges::fill(upper, std::numeric_limits<double>::infinity());
}

SparsePattern DrivenNlp::jacobian_pattern() const {
  SparsePattern pattern = empty_pattern(points_.size() * (parameters_ + kStencil));
  for (std::size_t k = 0; k < points_.size(); ++k) {
    for (std::size_t j = 0; j < parameters_; ++j) pattern.add(k, j);
    for (std::size_t j = 0; j < points_[k].count; ++j) {
      pattern.add(k, parameters_ + points_[k].first + j);
    }
  }
  return pattern;
}

SparsePattern DrivenNlp::hessian_pattern() const {
  SparsePattern pattern =
      empty_pattern(points_.size() * (parameters_ + 1) + parameters_ * (parameters_ + 1) / 2);
  for (std::size_t i = 0; i < parameters_; ++i) {
    for (std::size_t j = 0; j <= i; ++j) pattern.add(i, j);
  }
  for (std::size_t k = 0; k < points_.size(); ++k) {
    for (std::size_t j = 0; j < parameters_; ++j) pattern.add(parameters_ + k, j);
    pattern.add(parameters_ + k, parameters_ + k);
  }
  return pattern;
}

bool DrivenNlp::objective(std::span<const double> x, double& f) const {
  f = 0.0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    f += 0.5 * std::pow(points_[k].weight * (x[parameters_ + k] - points_[k].measured), 2);
  }
  return std::isfinite(f);
}

bool DrivenNlp::gradient(std::span<const double> x, std::span<double> g) const {
  std::fill_n(g.begin(), parameters_, 0.0);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const double w = points_[k].weight;
    g[parameters_ + k] = w * w * (x[parameters_ + k] - points_[k].measured);
  }
  return true;
}

void DrivenNlp::differentiate_at(std::span<const double> x, const Point& point, std::size_t k,
                                 Derivatives order) const {
  differentiate(problem_, x.first(parameters_), point.torque, x[parameters_ + k], order, law_);
}

bool DrivenNlp::constraint(std::span<const double> x, std::span<double> c) const {
  bool finite = true;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Point& point = points_[k];
    differentiate_at(x, point, k, Derivatives::none);
    double sum = point.known - point.width * law_.value;
    for (std::size_t j = 0; j < point.count; ++j) {
      sum += weights_[point.weights + j] * x[parameters_ + point.first + j];
    }
    c[k] = sum;
    finite = finite && std::isfinite(sum);
  }
  return finite;
}

bool DrivenNlp::jacobian(std::span<const double> x, std::span<double> values) const {
  auto at = values.begin();
  bool finite = true;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Point& point = points_[k];
    differentiate_at(x, point, k, Derivatives::first);
    for (std::size_t j = 0; j < parameters_; ++j) *at++ = -point.width * law_.gradient[j];
    for (std::size_t j = 0; j < point.count; ++j) {
      *at = weights_[point.weights + j];
      if (point.first + j == k) *at -= point.width * law_.slope;
      ++at;
    }
    finite = finite && std::isfinite(law_.slope);
  }
  return finite;
}

bool DrivenNlp::hessian(std::span<const double> x, double factor, std::span<const double> lambda,
                        std::span<double> values) const {
  const std::size_t triangle = parameters_ * (parameters_ + 1) / 2;
  std::fill_n(values.begin(), triangle, 0.0);
  auto at = values.begin() + static_cast<std::ptrdiff_t>(triangle);
  bool finite = true;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Point& point = points_[k];
    differentiate_at(x, point, k, Derivatives::second);
    const double share = -lambda[k] * point.width;
    for (std::size_t j = 0; j < triangle; ++j) values[j] += share * law_.curvature[j];
    for (std::size_t j = 0; j < parameters_; ++j) *at++ = share * law_.mixed[j];
    *at++ = factor * point.weight * point.weight + share * law_.bend;
    finite = finite && std::isfinite(law_.bend);
  }
  return finite;
}

}  // namespace flexspline::estimators
