#include "bench/rising_spline.hpp"

#include <algorithm>
#include <cmath>

namespace flexspline::data {
namespace {

constexpr std::size_t kCubics = RisingSpline::kSize + 1;
constexpr std::array<double, kCubics + 4> kKnots = {0, 0, 0, 0, 0.25, 0.5, 0.75, 1, 1, 1, 1};

/// Cubic B-splines at x in [0, 1] by the recursion of Cox and de Boor.
std::array<double, kCubics> cubic_splines(double x) {
  std::array<double, kCubics + 3> value{};
  std::size_t span = 3;
  while (span + 1 < kCubics && x >= kKnots[span + 1]) ++span;
  value[span] = 1.0;
  for (std::size_t degree = 1; degree <= 3; ++degree) {
    for (std::size_t i = span - degree; i <= span; ++i) {
      const double left = kKnots[i + degree] - kKnots[i];
      const double right = kKnots[i + degree + 1] - kKnots[i + 1];
      value[i] = (left > 0.0 ? (x - kKnots[i]) / left * value[i] : 0.0) +
                 (right > 0.0 ? (kKnots[i + degree + 1] - x) / right * value[i + 1] : 0.0);
    }
  }
  std::array<double, kCubics> out{};
  std::copy_n(value.begin(), kCubics, out.begin());
  return out;
}

}  // namespace

std::array<double, RisingSpline::kSize> RisingSpline::basis(double x) {
  const double inside = std::min(std::abs(x), 1.0);
  const auto cubic = cubic_splines(inside);
  std::array<double, kSize> out{};
  double tail = 0.0;
  // The integral of a quadratic B-spline is its support's third times the sum of the cubics after
  // it.
  for (std::size_t i = kSize; i-- > 0;) {
    tail += cubic[i + 1];
    out[i] = (kKnots[i + 4] - kKnots[i + 1]) / 3.0 * tail;
  }
  out[kSize - 1] += std::abs(x) - inside;  // only the last spline has a slope at 1, and it is 1
  for (double& value : out) value = std::copysign(value, x);
  return out;
}

double RisingSpline::operator()(double x) const {
  const auto values = basis(x);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), kSize).dot(coefficients_);
}

}  // namespace flexspline::data
