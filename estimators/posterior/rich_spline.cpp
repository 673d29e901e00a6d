#include "posterior/rich_spline.hpp"

#include <algorithm>
#include <cmath>

namespace flexspline::estimators {
namespace {

constexpr double kEven = 0.6;  // share of the coordinate that is even; the rest is logarithmic
constexpr int kMostSteps = 50;
constexpr double kClose = 1e-12;

}  // namespace

RichSpline::RichSpline(double from, double to, std::size_t intervals, double fine)
    : low_(from),
      high_(to),
      fine_(fine),
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

// Newton's iteration; as the coordinate bends towards the axis it never overshoots from zero on.
double RichSpline::at_coordinate(double u) const {
  double x = 0.0;
  for (int k = 0; k < kMostSteps; ++k) {
    const double step = (coordinate(x) - u) / coordinate_slope(x);
    x -= step;
    if (std::abs(step) < kClose * scale_) break;
  }
  return x;
}

std::array<double, 3> RichSpline::bend(Eigen::Index k) const {
  const auto centre = [&](Eigen::Index i) {
    return at_coordinate(from_ + static_cast<double>(i - 1) * width_) / (width_ * scale_);
  };
  const double before = centre(k + 1) - centre(k);
  const double after = centre(k + 2) - centre(k + 1);
  const double root = std::sqrt(0.5 * (before + after));
  return {1.0 / (before * root), -(1.0 / before + 1.0 / after) / root, 1.0 / (after * root)};
}

double RichSpline::beyond(double x) const {
  return std::abs(x - std::clamp(x, low_, high_)) / (width_ * scale_);
}

void RichSpline::value(double x, Eigen::Ref<Eigen::RowVectorXd> row) const {
  const double inside = std::clamp(x, low_, high_);
  const double out = (x - inside) * coordinate_slope(inside);
  const auto local = basis_.at(coordinate(inside));
  row = -at_zero_;
  for (std::size_t k = 0; k < 4; ++k) {
    row[static_cast<Eigen::Index>(local.first + k)] += local.value[k] + out * local.slope[k];
  }
}

void RichSpline::slope(double x, Eigen::Ref<Eigen::RowVectorXd> row) const {
  const double inside = std::clamp(x, low_, high_);
  const auto local = basis_.at(coordinate(inside));
  const double rate = coordinate_slope(inside);
  row.setZero();
  for (std::size_t k = 0; k < 4; ++k) {
    row[static_cast<Eigen::Index>(local.first + k)] = local.slope[k] * rate;
  }
}

}  // namespace flexspline::estimators
