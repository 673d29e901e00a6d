#include "posterior/rich_spline.hpp"

#include <algorithm>
#include <cmath>

namespace flexspline::estimators {
namespace {

constexpr double kEven = 0.6;  // share of the coordinate that is even; the rest is logarithmic

}  // namespace

RichSpline::RichSpline(double from, double to, std::size_t intervals, double fine)
    : fine_(fine),
      scale_(std::max(std::abs(from), std::abs(to))),
      from_(coordinate(from)),
      to_(coordinate(to)),
      width_((to_ - from_) / static_cast<double>(intervals)),
      basis_(from_, to_, intervals),
      at_zero_(Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(basis_.size()))) {
  Eigen::RowVectorXd row(size());
  value(0.0, row);
  at_zero_ = row;
}

double RichSpline::coordinate(double x) const {
  const double even = x / scale_;
  if (!(fine_ > 0.0)) return even;
  return kEven * even + (1.0 - kEven) * std::asinh(x / fine_) / std::asinh(scale_ / fine_);
}

double RichSpline::coordinate_slope(double x) const {
  if (!(fine_ > 0.0)) return 1.0 / scale_;
  return kEven / scale_ + (1.0 - kEven) / (std::hypot(x, fine_) * std::asinh(scale_ / fine_));
}

double RichSpline::beyond(double x) const {
  const double u = coordinate(x);
  return std::max({0.0, u - to_, from_ - u}) / width_;
}

void RichSpline::value(double x, Eigen::Ref<Eigen::RowVectorXd> row) const {
  const double u = coordinate(x);
  const double inside = std::clamp(u, from_, to_);
  const auto local = basis_.at(inside);
  row = -at_zero_;
  for (std::size_t k = 0; k < 4; ++k) {
    row[static_cast<Eigen::Index>(local.first + k)] +=
        local.value[k] + (u - inside) * local.slope[k];
  }
}

void RichSpline::slope(double x, Eigen::Ref<Eigen::RowVectorXd> row) const {
  const auto local = basis_.at(std::clamp(coordinate(x), from_, to_));
  const double rate = coordinate_slope(x);
  row.setZero();
  for (std::size_t k = 0; k < 4; ++k) {
    row[static_cast<Eigen::Index>(local.first + k)] = local.slope[k] * rate;
  }
}

}  // namespace flexspline::estimators
