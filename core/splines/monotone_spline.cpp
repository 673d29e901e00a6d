#include "flexspline/core/monotone_spline.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flexspline/core/error.hpp"

namespace flexspline {

MonotoneSpline::MonotoneSpline(LawSpec spec)
    : spec_(std::move(spec)),
      basis_(spec_.knots),
      odd_(spec_.coefficients.size() == basis_.size()) {
  const std::span<const double> all(spec_.coefficients);
  expects(odd_ || all.size() == 2 * basis_.size(), "one or two sets of knots + 3 coefficients");
  sides_[0].pieces = basis_.pieces(all.first(basis_.size()));
  sides_[1].pieces = odd_ ? sides_[0].pieces : basis_.pieces(all.last(basis_.size()));
}

double MonotoneSpline::side_value(const Side& side, double u) const {
  const std::size_t j = u >= 1.0 ? side.pieces.size() - 1 : basis_.interval(u);
  const auto& p = side.pieces[j];
  const double d = u - basis_.breakpoints()[j];
  return p[0] + d * (p[1] + d * (p[2] + d * p[3]));
}

double MonotoneSpline::side_slope(const Side& side, double u) const {
  const std::size_t j = u >= 1.0 ? side.pieces.size() - 1 : basis_.interval(u);
  const auto& p = side.pieces[j];
  const double d = u - basis_.breakpoints()[j];
  return p[1] + d * (2.0 * p[2] + d * 3.0 * p[3]);
}

double MonotoneSpline::value(double x) const {
  const double u = x / spec_.scale;
  return u >= 0.0 ? side_value(sides_[0], u) : -side_value(sides_[1], -u);
}

double MonotoneSpline::slope(double x) const {
  const double u = x / spec_.scale;
  return (u >= 0.0 ? side_slope(sides_[0], u) : side_slope(sides_[1], -u)) / spec_.scale;
}

void MonotoneSpline::gradient(double x, std::span<double> out) const {
  const double u = x / spec_.scale;
  std::fill(out.begin(), out.end(), 0.0);
  const bool negative = u < 0.0;
  const std::size_t n = basis_.size();
  auto part = out.subspan(negative && !odd_ ? n : 0, n);
  basis_.values(std::abs(u), part);
  if (negative) {
    for (double& g : part) g = -g;
  }
}

double MonotoneSpline::side_inverse(const Side& side, double y) const {
  const auto& pieces = side.pieces;
  std::size_t j = pieces.size() - 1;
  while (j > 0 && y < pieces[j][0]) --j;
  const auto& p = pieces[j];
  const double left = basis_.breakpoints()[j];
  if (j + 1 == pieces.size()) return left + (y - p[0]) / p[1];

  // Newton on the cubic, kept inside the interval by bisection.
  double low = 0.0;
  double high = basis_.breakpoints()[j + 1] - left;
  const double rise = pieces[j + 1][0] - p[0];
  double d = rise > 0.0 ? high * (y - p[0]) / rise : 0.0;
  for (int k = 0; k < 60; ++k) {
    const double error = p[0] + d * (p[1] + d * (p[2] + d * p[3])) - y;
    (error > 0.0 ? high : low) = d;
    const double step = error / (p[1] + d * (2.0 * p[2] + d * 3.0 * p[3]));
    double next = d - step;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (std::abs(next - d) <= 1e-15 * (1.0 + left)) return left + next;
    d = next;
  }
  return left + d;
}

double MonotoneSpline::inverse(double y) const {
  const double u = y >= 0.0 ? side_inverse(sides_[0], y) : -side_inverse(sides_[1], -y);
  return u * spec_.scale;
}

}  // namespace flexspline
