#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

#include "signals/smoothing.hpp"

namespace flexspline {
namespace {

constexpr Eigen::Index kMostHarmonics = 40;
constexpr double kSignificance = 4.0;  // standard errors of a harmonic's amplitude

Eigen::MatrixXd harmonics(std::span<const double> time, double period, Eigen::Index order) {
  const auto n = static_cast<Eigen::Index>(time.size());
  Eigen::MatrixXd columns(n, 2 * order + 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double angle =
        2.0 * std::numbers::pi * (time[static_cast<std::size_t>(i)] - time.front()) / period;
    columns(i, 0) = 1.0;
    for (Eigen::Index k = 1; k <= order; ++k) {
      columns(i, 2 * k - 1) = std::cos(static_cast<double>(k) * angle);
      columns(i, 2 * k) = std::sin(static_cast<double>(k) * angle);
    }
  }
  return columns;
}

// Residual sums of squares of all orders come out of one orthogonal factorisation.
Eigen::Index best_order(const Eigen::VectorXd& rotated, double total, Eigen::Index samples,
                        Eigen::Index most) {
  const double n = static_cast<double>(samples);
  double left = total - rotated[0] * rotated[0];
  double best = std::numeric_limits<double>::infinity();
  Eigen::Index order = 1;
  for (Eigen::Index k = 1; k <= most; ++k) {
    left -= rotated[2 * k - 1] * rotated[2 * k - 1] + rotated[2 * k] * rotated[2 * k];
    const double criterion = n * std::log(std::max(left, 1e-30 * total) / n) +
                             (2.0 * static_cast<double>(k)) * std::log(n);
    if (criterion < best) {
      best = criterion;
      order = k;
    }
  }
  return order;
}

}  // namespace

SmoothSignal smooth_by_harmonics(std::span<const double> time, std::span<const double> samples,
                                 double period, Harmonics kept) {
  const auto n = static_cast<Eigen::Index>(time.size());
  const double per_cycle = static_cast<double>(n) * period / (time.back() - time.front());
  const Eigen::Index most = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(per_cycle / 6.0), 1,
                                                     std::min(kMostHarmonics, (n - 2) / 4));
  const Eigen::MatrixXd columns = harmonics(time, period, most);
  const Eigen::Map<const Eigen::VectorXd> y(samples.data(), n);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  const Eigen::VectorXd rotated = qr.householderQ().transpose() * y;
  const bool choose = kept == Harmonics::significant;
  const Eigen::Index order = choose ? best_order(rotated, y.squaredNorm(), n, most) : most;

  const Eigen::Index used = 2 * order + 1;
  Eigen::VectorXd c = qr.matrixQR()
                          .topLeftCorner(used, used)
                          .triangularView<Eigen::Upper>()
                          .solve(rotated.head(used));
  const double noise =
      (y - columns.leftCols(used) * c).norm() / std::sqrt(static_cast<double>(n - used));
  const double error = noise * std::sqrt(2.0 / static_cast<double>(n));
  Eigen::Index freedom = used;
  for (Eigen::Index k = 2; choose && k <= order; ++k) {
    if (std::hypot(c[2 * k - 1], c[2 * k]) >= kSignificance * error) continue;
    c.segment(2 * k - 1, 2).setZero();
    freedom -= 2;
  }

  const auto size = static_cast<std::size_t>(n);
  const std::vector<double> empty(size);
  const double share = static_cast<double>(freedom) / static_cast<double>(n);
  SmoothSignal signal{empty, empty, empty, noise,
                      std::vector<double>(size, noise * std::sqrt(share))};
  for (std::size_t i = 0; i < size; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    signal.value[i] = c[0];
    for (Eigen::Index k = 1; k <= order; ++k) {
      const double w = 2.0 * std::numbers::pi * static_cast<double>(k) / period;
      const double in_phase = columns(row, 2 * k - 1);
      const double quadrature = columns(row, 2 * k);
      const double value = c[2 * k - 1] * in_phase + c[2 * k] * quadrature;
      signal.value[i] += value;
      signal.rate[i] += w * (c[2 * k] * in_phase - c[2 * k - 1] * quadrature);
      signal.second[i] -= w * w * value;
    }
  }
  return signal;
}

}  // namespace flexspline
