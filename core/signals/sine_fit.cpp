#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

#include "flexspline/core/signals.hpp"

namespace flexspline {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr std::size_t kScanSamples = 2000;
constexpr int kScanFrequencies = 600;
constexpr double kSettled = 1e-12;  // change of the number of cycles that ends the search

struct Sums {
  SineFit fit;
  double residual = 0.0;  // sum of squares
};

double mean_of(std::span<const double> signal) {
  double sum = 0.0;
  for (double y : signal) sum += y;
  return sum / static_cast<double>(signal.size());
}

// Gauss-Newton on mean, in-phase, quadrature and frequency; linear but for the last.
Sums refine(std::span<const double> time, std::span<const double> signal, double frequency,
            int iterations) {
  const double t0 = time.front();
  const double span = time.back() - t0;
  Eigen::Vector4d p(mean_of(signal), 0.0, 0.0, frequency);
  Sums sums;
  for (int k = 0; k <= iterations; ++k) {
    const bool linear = k == 0;  // amplitude first: the frequency has no slope without one
    const Eigen::Index columns = linear ? 3 : 4;
    Eigen::Matrix4d products = Eigen::Matrix4d::Zero();
    Eigen::Vector4d projections = Eigen::Vector4d::Zero();
    Eigen::Vector4d row = Eigen::Vector4d::Zero();
    for (std::size_t i = 0; i < time.size(); ++i) {
      const double angle = kTwoPi * p[3] * (time[i] - t0);
      const double c = std::cos(angle);
      const double s = std::sin(angle);
      row[0] = 1.0;
      row[1] = c;
      row[2] = s;
      if (!linear) row[3] = kTwoPi * (time[i] - t0) * (p[2] * c - p[1] * s);
      const double r = signal[i] - (p[0] + p[1] * c + p[2] * s);
      products += row * row.transpose();
      projections += row * r;
    }
    const Eigen::MatrixXd normal = products.topLeftCorner(columns, columns);
    Eigen::VectorXd step = normal.ldlt().solve(projections.head(columns));
    if (!linear) step[3] = std::clamp(step[3], -0.25 / span, 0.25 / span);
    p.head(columns) += step;
    if (!linear && std::abs(step[3]) * span < kSettled) break;
  }
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double angle = kTwoPi * p[3] * (time[i] - t0);
    const double r = signal[i] - (p[0] + p[1] * std::cos(angle) + p[2] * std::sin(angle));
    sums.residual += r * r;
  }
  sums.fit = {.mean = p[0],
              .amplitude = std::hypot(p[1], p[2]),
              .frequency_hz = p[3],
              .phase = std::atan2(-p[2], p[1]) - kTwoPi * p[3] * t0};
  return sums;
}

double strongest_frequency(std::span<const double> time, std::span<const double> signal) {
  const std::size_t stride = std::max<std::size_t>(1, time.size() / kScanSamples);
  std::vector<double> t;
  std::vector<double> y;
  const double mean = mean_of(signal);
  for (std::size_t i = 0; i < time.size(); i += stride) {
    t.push_back(time[i] - time.front());
    y.push_back(signal[i] - mean);
  }
  const double span = t.back();
  const double highest = static_cast<double>(t.size()) / (8.0 * span);
  const double lowest = 0.5 / span;
  double best = lowest;
  double power = -1.0;
  for (int k = 0; k < kScanFrequencies; ++k) {
    const double frequency =
        lowest * std::pow(highest / lowest, static_cast<double>(k) / (kScanFrequencies - 1));
    double c = 0.0;
    double s = 0.0;
    for (std::size_t i = 0; i < t.size(); ++i) {
      c += y[i] * std::cos(kTwoPi * frequency * t[i]);
      s += y[i] * std::sin(kTwoPi * frequency * t[i]);
    }
    if (c * c + s * s > power) {
      power = c * c + s * s;
      best = frequency;
    }
  }
  return best;
}

}  // namespace

SineFit fit_sine(std::span<const double> time, std::span<const double> signal,
                 std::optional<double> frequency_guess) {
  const double start = frequency_guess ? *frequency_guess : strongest_frequency(time, signal);
  Sums sums = refine(time, signal, start, 12);
  double total = 0.0;
  const double mean = mean_of(signal);
  for (double y : signal) total += (y - mean) * (y - mean);
  sums.fit.explained = total > 0.0 ? 1.0 - sums.residual / total : 0.0;
  return sums.fit;
}

}  // namespace flexspline
