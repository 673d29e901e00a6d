#include "flexspline/core/integrated_basis.hpp"

#include <algorithm>

namespace flexspline {
namespace {

// Cox-de Boor recursion for one quadratic B-spline on a clamped knot vector.
double quadratic_bspline(std::span<const double> knots, std::size_t i, double u) {
  std::array<double, 3> b{};
  for (std::size_t k = 0; k < 3; ++k) {
    b[k] = (knots[i + k] <= u && u < knots[i + k + 1]) ? 1.0 : 0.0;
  }
  for (std::size_t degree = 1; degree <= 2; ++degree) {
    for (std::size_t k = 0; k + degree < 3; ++k) {
      const double left = knots[i + k + degree] - knots[i + k];
      const double right = knots[i + k + degree + 1] - knots[i + k + 1];
      const double a = left > 0 ? (u - knots[i + k]) / left * b[k] : 0.0;
      const double c = right > 0 ? (knots[i + k + degree + 1] - u) / right * b[k + 1] : 0.0;
      b[k] = a + c;
    }
  }
  return b[0];
}

}  // namespace

IntegratedBasis::IntegratedBasis(std::span<const double> interior_knots) {
  breakpoints_.push_back(0.0);
  breakpoints_.insert(breakpoints_.end(), interior_knots.begin(), interior_knots.end());
  breakpoints_.push_back(1.0);
  intervals_ = breakpoints_.size() - 1;
  size_ = interior_knots.size() + 3;

  std::vector<double> knots(2, 0.0);
  knots.insert(knots.end(), breakpoints_.begin(), breakpoints_.end());
  knots.insert(knots.end(), 2, 1.0);

  table_.resize(size_ * intervals_);
  starts_.resize(size_ * intervals_);
  for (std::size_t i = 0; i < size_; ++i) {
    double integral = 0.0;
    for (std::size_t j = 0; j < intervals_; ++j) {
      const double left = breakpoints_[j];
      const double width = breakpoints_[j + 1] - left;
      // Three points inside the interval fix the quadratic.
      const double y1 = quadratic_bspline(knots, i, left + 0.25 * width);
      const double y2 = quadratic_bspline(knots, i, left + 0.5 * width);
      const double y3 = quadratic_bspline(knots, i, left + 0.75 * width);
      const double second = 8.0 * (y1 - 2.0 * y2 + y3) / (width * width);
      const double first = (y3 - y1) / (0.5 * width) - second * width;
      const double at_left = y2 - first * 0.5 * width - second * 0.25 * width * width;
      table_[i * intervals_ + j] = {at_left, first, second, first / 2.0, second / 3.0};
      starts_[j * size_ + i] = integral;
      integral += width * (at_left + width * (first / 2.0 + width * second / 3.0));
    }
  }
}

std::size_t IntegratedBasis::interval(double u) const {
  std::size_t j = 0;
  while (j + 1 < intervals_ && u >= breakpoints_[j + 1]) ++j;
  return j;
}

void IntegratedBasis::values(double u, std::span<double> out) const {
  const std::size_t j = interval(u);
  const double inside = std::min(u, 1.0);
  const double d = inside - breakpoints_[j];
  const double* start = &starts_[j * size_];
  for (std::size_t i = 0; i < size_; ++i) out[i] = start[i];
  for (std::size_t i = j; i < j + kActive; ++i) {
    const Quadratic& q = piece(i, j);
    out[i] += d * (q.q0 + d * (q.half_q1 + d * q.third_q2));
    if (u > 1.0) out[i] += (u - 1.0) * (q.q0 + d * (q.q1 + d * q.q2));
  }
}

void IntegratedBasis::slopes(double u, std::span<double> out) const {
  const std::size_t j = interval(u);
  const double d = std::min(u, 1.0) - breakpoints_[j];
  for (std::size_t i = 0; i < size_; ++i) {
    const Quadratic& q = piece(i, j);
    out[i] = q.q0 + d * (q.q1 + d * q.q2);
  }
}

std::vector<std::array<double, 4>> IntegratedBasis::pieces(
    std::span<const double> coefficients) const {
  std::vector<std::array<double, 4>> result(intervals_ + 1);
  for (std::size_t j = 0; j < intervals_; ++j) {
    auto& p = result[j];
    for (std::size_t i = 0; i < size_; ++i) {
      const Quadratic& q = piece(i, j);
      p[0] += coefficients[i] * starts_[j * size_ + i];
      p[1] += coefficients[i] * q.q0;
      p[2] += coefficients[i] * q.q1 / 2.0;
      p[3] += coefficients[i] * q.q2 / 3.0;
    }
  }
  const auto& last = result[intervals_ - 1];
  const double w = 1.0 - breakpoints_[intervals_ - 1];
  result[intervals_] = {last[0] + w * (last[1] + w * (last[2] + w * last[3])),
                        last[1] + w * (2.0 * last[2] + w * 3.0 * last[3]), 0.0, 0.0};
  return result;
}

}  // namespace flexspline
