#include "paper/odd_polynomial.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace flexspline::studies {
namespace {

/// Positive x with c0 + c1 x^2 + … = 0. Each coefficient is scaled by its power of a typical root,
/// as published ones differ by 19 orders of magnitude.
std::vector<double> roots_in_square(std::array<double, 5> c) {
  constexpr int kDegree = 4;
  const double scale = std::pow(std::abs(c.front() / c.back()), 1.0 / kDegree);
  double power = 1.0;
  for (double& coefficient : c) {
    coefficient *= power;
    power *= scale;
  }
  Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
  companion.bottomLeftCorner<3, 3>().setIdentity();
  for (int i = 0; i < kDegree; ++i) {
    companion(i, kDegree - 1) = -c[static_cast<std::size_t>(i)] / c.back();
  }
  std::vector<double> roots;
  for (const std::complex<double>& root : companion.eigenvalues()) {
    if (std::abs(root.imag()) < 1e-9 * std::abs(root) && root.real() > 0.0) {
      roots.push_back(std::sqrt(root.real() * scale));
    }
  }
  std::ranges::sort(roots);
  return roots;
}

}  // namespace

double OddPolynomial::value(double x) const {
  double sum = 0.0;
  for (std::size_t k = coefficients.size(); k-- > 0;) sum = sum * x * x + coefficients[k];
  return sum * x;
}

double OddPolynomial::slope(double x) const {
  double sum = 0.0;
  for (std::size_t k = coefficients.size(); k-- > 0;) {
    sum = sum * x * x + static_cast<double>(2 * k + 1) * coefficients[k];
  }
  return sum;
}

double OddPolynomial::cancellation(double x) const {
  double sum = 0.0;
  double power = x;
  for (const double coefficient : coefficients) {
    sum += std::abs(coefficient * power);
    power *= x * x;
  }
  return sum / std::abs(value(x));
}

std::vector<double> OddPolynomial::zeros() const { return roots_in_square(coefficients); }

std::vector<double> OddPolynomial::slope_zeros() const {
  std::array<double, 5> slopes = coefficients;
  for (std::size_t k = 0; k < slopes.size(); ++k) slopes[k] *= static_cast<double>(2 * k + 1);
  return roots_in_square(slopes);
}

}  // namespace flexspline::studies
