#include "paper/damping_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/QR>
#include <Eigen/SVD>

#include "paper/odd_polynomial.hpp"

namespace flexspline::studies {
namespace {

constexpr int kPoints = 2001;

struct ScaledShape {
  double coefficient;
  double rms_percent;
};

template <class Shape>
ScaledShape best_multiple(const Shape& shape) {
  double cross = 0.0;
  double square = 0.0;
  double peak = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double v = static_cast<double>(i) / (kPoints - 1);
    const double g = kDamping.value(v * kSpeedDeg);
    cross += g * shape(v);
    square += shape(v) * shape(v);
    peak = std::max(peak, g);
  }
  const double coefficient = cross / square;
  double misfit = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double v = static_cast<double>(i) / (kPoints - 1);
    misfit += std::pow(kDamping.value(v * kSpeedDeg) - coefficient * shape(v), 2);
  }
  return {coefficient, 100.0 * std::sqrt(misfit / kPoints) / peak};
}

}  // namespace

PowerLaw fit_power_law() {
  const auto at = [](double n) { return best_multiple([n](double v) { return std::pow(v, n); }); };
  double low = 1.0;
  double high = 3.0;
  while (high - low > 1e-7) {
    const double left = low + (high - low) / 3.0;
    const double right = high - (high - low) / 3.0;
    if (at(left).rms_percent < at(right).rms_percent)
      high = right;
    else
      low = left;
  }
  const ScaledShape best = at(low);
  return {best.coefficient, low, best.rms_percent};
}

double shape_misfit_percent(double (*shape)(double)) { return best_multiple(shape).rms_percent; }

double vandermonde_condition(double range) {
  using Real = long double;
  constexpr int kSamples = 4000;
  Eigen::Matrix<Real, Eigen::Dynamic, 5> design(kSamples, 5);
  for (int i = 0; i < kSamples; ++i) {
    const Real x = static_cast<Real>(range) *
                   std::cos(static_cast<Real>(2 * i) * std::numbers::pi_v<Real> / kSamples);
    Real power = x;
    for (int j = 0; j < 5; ++j, power *= x * x) design(i, j) = power;
  }
  const Eigen::JacobiSVD<Eigen::Matrix<Real, Eigen::Dynamic, 5>,
                         Eigen::ColPivHouseholderQRPreconditioner>
      svd(design);
  return static_cast<double>(svd.singularValues()(0) / svd.singularValues()(4));
}

}  // namespace flexspline::studies
