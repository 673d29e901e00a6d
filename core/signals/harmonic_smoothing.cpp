#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

#include "signals/smoothing.hpp"

namespace flexspline {
namespace {

constexpr Eigen::Index kMostHarmonics = 40;
constexpr double kSignificance = 4.0;  // standard errors of a harmonic's amplitude

// 1, cos, sin, cos 2, sin 2, ... of an angle, by rotation.
template <class Row>
void fill_harmonics(double angle, Row&& row) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  row[0] = 1.0;
  row[1] = c;
  row[2] = s;
  for (Eigen::Index k = 3; k + 1 < row.size(); k += 2) {
    row[k] = c * row[k - 2] - s * row[k - 1];
    row[k + 1] = s * row[k - 2] + c * row[k - 1];
  }
}

double angle_at(std::span<const double> time, std::size_t i, double period) {
  return 2.0 * std::numbers::pi * (time[i] - time.front()) / period;
}

// Triangular factor of the harmonics with the signals as their last columns, chunk by chunk: a long
// record has as many rows as samples, but never needs all of them at once.
Eigen::MatrixXd triangular_factor(std::span<const double> time, std::span<const Sampled> signals,
                                  double period, Eigen::Index order) {
  constexpr std::size_t kChunk = 2048;
  const Eigen::Index harmonics = 2 * order + 1;
  const Eigen::Index columns = harmonics + static_cast<Eigen::Index>(signals.size());
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(columns, columns);
  Eigen::VectorXd row(harmonics);
  for (std::size_t first = 0; first < time.size(); first += kChunk) {
    const std::size_t count = std::min(kChunk, time.size() - first);
    Eigen::MatrixXd stacked(columns + static_cast<Eigen::Index>(count), columns);
    stacked.topRows(columns) = factor;
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Index at = columns + static_cast<Eigen::Index>(i);
      fill_harmonics(angle_at(time, first + i, period), row);
      stacked.row(at).head(harmonics) = row;
      for (std::size_t s = 0; s < signals.size(); ++s) {
        stacked(at, harmonics + static_cast<Eigen::Index>(s)) = signals[s].samples[first + i];
      }
    }
    const Eigen::HouseholderQR<Eigen::Ref<Eigen::MatrixXd>> qr(stacked);
    factor = stacked.topRows(columns).triangularView<Eigen::Upper>();
  }
  return factor;
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

// Coefficients of one signal, with what choosing them cost.
struct Series {
  Eigen::VectorXd coefficients;
  double noise = 0.0;
  double freedom = 0.0;
};

// rotated: the signal's column of the triangular factor.
Series series_of(const Eigen::MatrixXd& factor, const Eigen::VectorXd& rotated, Eigen::Index most,
                 Eigen::Index n, Harmonics kept) {
  const bool choose = kept == Harmonics::significant;
  const Eigen::Index order = choose ? best_order(rotated, rotated.squaredNorm(), n, most) : most;
  const Eigen::Index used = 2 * order + 1;
  Series series;
  Eigen::VectorXd& c = series.coefficients;
  c = factor.topLeftCorner(used, used).triangularView<Eigen::Upper>().solve(rotated.head(used));
  series.noise =
      rotated.tail(rotated.size() - used).norm() / std::sqrt(static_cast<double>(n - used));
  const double error = series.noise * std::sqrt(2.0 / static_cast<double>(n));
  series.freedom = static_cast<double>(used);
  for (Eigen::Index k = 2; choose && k <= order; ++k) {
    if (std::hypot(c[2 * k - 1], c[2 * k]) >= kSignificance * error) continue;
    c.segment(2 * k - 1, 2).setZero();
    series.freedom -= 2.0;
  }
  return series;
}

SmoothSignal signal_of(const Series& series, std::span<const double> time, double period) {
  const std::size_t size = time.size();
  const Eigen::VectorXd& c = series.coefficients;
  const std::vector<double> empty(size);
  const double share = series.freedom / static_cast<double>(size);
  SmoothSignal signal{empty, empty, empty, series.noise,
                      std::vector<double>(size, series.noise * std::sqrt(share))};
  Eigen::VectorXd row(c.size());
  for (std::size_t i = 0; i < size; ++i) {
    fill_harmonics(angle_at(time, i, period), row);
    signal.value[i] = c[0];
    for (Eigen::Index k = 1; 2 * k < c.size(); ++k) {
      const double w = 2.0 * std::numbers::pi * static_cast<double>(k) / period;
      const double in_phase = row[2 * k - 1];
      const double quadrature = row[2 * k];
      const double value = c[2 * k - 1] * in_phase + c[2 * k] * quadrature;
      signal.value[i] += value;
      signal.rate[i] += w * (c[2 * k] * in_phase - c[2 * k - 1] * quadrature);
      signal.second[i] -= w * w * value;
    }
  }
  return signal;
}

}  // namespace

std::vector<SmoothSignal> smooth_by_harmonics(std::span<const double> time,
                                              std::span<const Sampled> signals, double period) {
  const auto n = static_cast<Eigen::Index>(time.size());
  const double per_cycle = static_cast<double>(n) * period / (time.back() - time.front());
  const Eigen::Index most = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(per_cycle / 6.0), 1,
                                                     std::min(kMostHarmonics, (n - 2) / 4));
  const Eigen::MatrixXd factor = triangular_factor(time, signals, period, most);
  std::vector<SmoothSignal> smooth;
  for (const Sampled& signal : signals) {
    const auto column = 2 * most + 1 + static_cast<Eigen::Index>(smooth.size());
    const Series series = series_of(factor, factor.col(column), most, n, signal.kept);
    smooth.push_back(signal_of(series, time, period));
  }
  return smooth;
}

}  // namespace flexspline
