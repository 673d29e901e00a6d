#include "flexspline/core/spline.hpp"

#include <algorithm>

#include "flexspline/core/error.hpp"

namespace flexspline {

Spline::Spline(std::span<const double> x, std::span<const double> y)
    : x_(x.begin(), x.end()), y_(y.begin(), y.end()), slope_(x.size()) {
  expects(x.size() == y.size() && x.size() >= 3, "a spline goes through three points or more");
  const std::size_t n = x.size();
  auto secant = [&](std::size_t i) { return (y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i]); };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double left = x_[i] - x_[i - 1];
    const double right = x_[i + 1] - x_[i];
    slope_[i] = (secant(i - 1) * right + secant(i) * left) / (left + right);
  }
  slope_[0] = 2.0 * secant(0) - slope_[1];
  slope_[n - 1] = 2.0 * secant(n - 2) - slope_[n - 2];
}

std::size_t Spline::interval(double x) const {
  const std::size_t last = x_.size() - 2;
  if (hint_ < last && x >= x_[hint_ + 1] && x < x_[hint_ + 2]) return ++hint_;
  if (x < x_[hint_] || x >= x_[hint_ + 1]) {
    const auto above = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
    hint_ = std::min(last, static_cast<std::size_t>(above - x_.begin()) - 1);
  }
  return hint_;
}

double Spline::value(double x) const {
  if (x <= x_.front()) return y_.front();
  if (x >= x_.back()) return y_.back();
  const std::size_t i = interval(x);
  const double h = x_[i + 1] - x_[i];
  const double u = (x - x_[i]) / h;
  const double v = 1.0 - u;
  return v * v * (1.0 + 2.0 * u) * y_[i] + u * u * (1.0 + 2.0 * v) * y_[i + 1] +
         h * u * v * (v * slope_[i] - u * slope_[i + 1]);
}

double Spline::slope(double x) const {
  if (x <= x_.front() || x >= x_.back()) return 0.0;
  const std::size_t i = interval(x);
  const double h = x_[i + 1] - x_[i];
  const double u = (x - x_[i]) / h;
  const double v = 1.0 - u;
  return 6.0 * u * v * (y_[i + 1] - y_[i]) / h + v * (v - 2.0 * u) * slope_[i] +
         u * (u - 2.0 * v) * slope_[i + 1];
}

}  // namespace flexspline
