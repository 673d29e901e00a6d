#include "ode_fit/smooth_states.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

namespace flexspline::estimators {
namespace {

constexpr Eigen::Index kMostIntervals = 80;
constexpr double kRidge = 1e-10;  // where no sample tells a spline

Eigen::MatrixXd second_differences(Eigen::Index count) {
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(std::max<Eigen::Index>(count - 2, 0), count);
  for (Eigen::Index k = 0; k < d.rows(); ++k) d.row(k).segment(k, 3) << 1.0, -2.0, 1.0;
  return d;
}

}  // namespace

SmoothCurve::SmoothCurve(const std::vector<double>& time, const std::vector<double>& value,
                         const std::vector<double>& weight) {
  const auto n = static_cast<Eigen::Index>(time.size());
  from_ = time.front();
  intervals_ = std::clamp<Eigen::Index>(n, 4, kMostIntervals);
  step_ = std::max(time.back() - time.front(), std::numeric_limits<double>::min()) /
          static_cast<double>(intervals_);
  const Eigen::Index count = intervals_ + 3;
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(n, count);
  Eigen::VectorXd right(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto index = static_cast<std::size_t>(k);
    const double root = std::sqrt(weight[index]);
    const Local at = local(time[index]);
    basis.row(k).segment(at.first, 4) = root * at.value.transpose();
    right[k] = root * value[index];
  }
  const Eigen::MatrixXd d = second_differences(count);
  const Eigen::MatrixXd penalty = d.transpose() * d;
  Eigen::MatrixXd normal = basis.transpose() * basis;
  const double size = normal.trace() / static_cast<double>(count);
  normal.diagonal().array() += kRidge * size;
  // In the basis where both are diagonal a trial of a penalty costs nothing.
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(penalty, normal);
  const Eigen::VectorXd projected = eigen.eigenvectors().transpose() * (basis.transpose() * right);
  const Eigen::VectorXd bend = eigen.eigenvalues().cwiseMax(0.0);
  const double outside = std::max(0.0, right.squaredNorm() - projected.squaredNorm());
  double least = std::numeric_limits<double>::infinity();
  for (int k = -16; k <= 16; ++k) {
    const double lambda = size * std::pow(10.0, 0.5 * k);
    const Eigen::VectorXd kept = (1.0 + lambda * bend.array()).inverse();
    const double left = outside + (projected.array() * (1.0 - kept.array())).square().sum();
    const double freedom =
        static_cast<double>(n) - std::min(kept.sum(), 0.98 * static_cast<double>(n));
    const double score = left / (freedom * freedom);
    if (!(score < least)) continue;
    least = score;
    coefficient_ = eigen.eigenvectors() * kept.cwiseProduct(projected);
  }
}

SmoothCurve::Local SmoothCurve::local(double t) const {
  const double place = (t - from_) / step_;
  const auto interval =
      std::clamp<Eigen::Index>(static_cast<Eigen::Index>(std::floor(place)), 0, intervals_ - 1);
  const double u = place - static_cast<double>(interval);
  const double v = 1.0 - u;
  Local at{interval, {}, {}};
  at.value << v * v * v, 3.0 * u * u * u - 6.0 * u * u + 4.0,
      -3.0 * u * u * u + 3.0 * u * u + 3.0 * u + 1.0, u * u * u;
  at.slope << -3.0 * v * v, 9.0 * u * u - 12.0 * u, -9.0 * u * u + 6.0 * u + 3.0, 3.0 * u * u;
  at.value /= 6.0;
  at.slope /= 6.0 * step_;
  return at;
}

double SmoothCurve::value(double t) const {
  const Local at = local(t);
  return at.value.dot(coefficient_.segment<4>(at.first));
}

double SmoothCurve::slope(double t) const {
  const Local at = local(t);
  return at.slope.dot(coefficient_.segment<4>(at.first));
}

}  // namespace flexspline::estimators
