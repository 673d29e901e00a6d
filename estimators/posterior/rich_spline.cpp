#include "posterior/rich_spline.hpp"

#include <algorithm>
#include <cmath>

namespace flexspline::estimators {
namespace {

constexpr double kEven = 0.6;  // share of the coordinate that is even; the rest is logarithmic
constexpr int kMostSteps = 50;
constexpr double kClose = 1e-12;

double weighed(const std::array<double, 4>& weights,
               const Eigen::Ref<const Eigen::VectorXd>& coefficients, Eigen::Index first) {
  return coefficients.segment<4>(first).dot(Eigen::Map<const Eigen::Vector4d>(weights.data()));
}

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
      zero_(at(0.0)) {}

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

RichSpline::Local RichSpline::at(double x) const {
  const double inside = std::clamp(x, low_, high_);
  const double out = (x - inside) * coordinate_slope(inside);
  const double rate = coordinate_slope(inside);
  const auto basis = basis_.at(coordinate(inside));
  Local local{static_cast<Eigen::Index>(basis.first), basis.value, basis.slope};
  for (std::size_t k = 0; k < 4; ++k) {
    local.value[k] += out * basis.slope[k];
    local.slope[k] *= rate;
  }
  return local;
}

double RichSpline::value(const Local& at,
                         const Eigen::Ref<const Eigen::VectorXd>& coefficients) const {
  return weighed(at.value, coefficients, at.first) -
         weighed(zero_.value, coefficients, zero_.first);
}

double RichSpline::slope(const Local& at, const Eigen::Ref<const Eigen::VectorXd>& coefficients) {
  return weighed(at.slope, coefficients, at.first);
}

void RichSpline::add_value(const Local& at, double weight,
                           Eigen::Ref<Eigen::RowVectorXd> row) const {
  for (Eigen::Index k = 0; k < 4; ++k) {
    const auto i = static_cast<std::size_t>(k);
    row[at.first + k] += weight * at.value[i];
    row[zero_.first + k] -= weight * zero_.value[i];
  }
}

void RichSpline::value(double x, Eigen::Ref<Eigen::RowVectorXd> row) const {
  row.setZero();
  add_value(at(x), 1.0, row);
}

void RichSpline::slope(double x, Eigen::Ref<Eigen::RowVectorXd> row) const {
  row.setZero();
  const Local local = at(x);
  for (std::size_t k = 0; k < 4; ++k) {
    row[local.first + static_cast<Eigen::Index>(k)] = local.slope[k];
  }
}

}  // namespace flexspline::estimators
