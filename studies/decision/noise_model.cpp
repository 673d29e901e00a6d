#include "decision/noise_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "diagnosis/middle.hpp"

namespace flexspline::studies::decision {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kHighestOrder = 32;
constexpr double kOutlying = 5.0;     // standard deviations: beyond it a row is clipped
constexpr double kSharedRows = 50.0;  // a recording's scale is worth so many rows of the others'
constexpr double kMad = 1.4826;       // standard deviation over median absolute value
constexpr std::array kFreedoms = {3.0, 5.0, 10.0};

std::vector<double> scales(const Rows& rows, std::size_t recordings, const VectorXd& e) {
  std::vector<std::vector<double>> sizes(recordings);
  std::vector<double> all;
  for (Index i = 0; i < rows.size(); ++i) {
    sizes[rows.segment[static_cast<std::size_t>(i)]].push_back(std::abs(e[i]));
    all.push_back(std::abs(e[i]));
  }
  const double common = std::max(kMad * middle(all), 1e-300);
  std::vector<double> scale;
  for (const auto& one : sizes) {
    const double own = kMad * middle(one);
    const auto n = static_cast<double>(one.size());
    scale.push_back(std::sqrt((n * own * own + kSharedRows * common * common) / (n + kSharedRows)));
  }
  return scale;
}

// Of the recordings together, each over its own scale; lags 0 to kHighestOrder.
std::vector<double> autocovariance(const Rows& rows, const VectorXd& e,
                                   const std::vector<double>& scale) {
  std::vector<double> sum(kHighestOrder + 1, 0.0);
  VectorXd u(rows.size());
  for (Index i = 0; i < rows.size(); ++i) {
    u[i] =
        std::clamp(e[i] / scale[rows.segment[static_cast<std::size_t>(i)]], -kOutlying, kOutlying);
  }
  for (Index i = 0; i < rows.size(); ++i) {
    const Index most = std::min<Index>(kHighestOrder, rows.behind[static_cast<std::size_t>(i)]);
    for (Index k = 0; k <= most; ++k) sum[static_cast<std::size_t>(k)] += u[i] * u[i - k];
  }
  for (double& value : sum) value /= static_cast<double>(rows.size());
  return sum;
}

struct Predictors {
  std::vector<std::vector<double>> a;
  std::vector<double> variance;
};

Predictors levinson(const std::vector<double>& r, int order) {
  Predictors p{{{}}, {r[0]}};
  for (int m = 1; m <= order; ++m) {
    const auto& last = p.a.back();
    double reflection = r[static_cast<std::size_t>(m)];
    for (int k = 1; k < m; ++k) {
      reflection -= last[static_cast<std::size_t>(k - 1)] * r[static_cast<std::size_t>(m - k)];
    }
    reflection /= p.variance.back();
    std::vector<double> next(static_cast<std::size_t>(m));
    for (int k = 1; k < m; ++k) {
      next[static_cast<std::size_t>(k - 1)] =
          last[static_cast<std::size_t>(k - 1)] -
          reflection * last[static_cast<std::size_t>(m - k - 1)];
    }
    next.back() = reflection;
    p.variance.push_back(
        std::max(p.variance.back() * (1.0 - reflection * reflection), 1e-12 * r[0]));
    p.a.push_back(std::move(next));
  }
  return p;
}

int best_order(const Predictors& p, double n) {
  int best = 0;
  double least = 1e300;
  for (std::size_t m = 0; m < p.variance.size(); ++m) {
    const double criterion = n * std::log(p.variance[m]) + static_cast<double>(m) * std::log(n);
    if (criterion < least) least = criterion, best = static_cast<int>(m);
  }
  return best;
}

// Largest root of the autoregression: its memory fades by that much a row.
double radius(const std::vector<double>& a) {
  const auto p = static_cast<Index>(a.size());
  if (p == 0) return 0.0;
  MatrixXd companion = MatrixXd::Zero(p, p);
  for (Index k = 0; k < p; ++k) companion(0, k) = a[static_cast<std::size_t>(k)];
  if (p > 1) companion.diagonal(-1).setOnes();
  return companion.eigenvalues().cwiseAbs().maxCoeff();
}

double t_log_density(double z2, double nu) {
  return std::lgamma(0.5 * (nu + 1.0)) - std::lgamma(0.5 * nu) -
         0.5 * std::log(nu * 3.14159265358979) - 0.5 * (nu + 1.0) * std::log1p(z2 / nu);
}

// Freedom of the innovations by likelihood, and the weights that it means.
void weigh(NoiseModel& noise, const VectorXd& e) {
  double best = -0.5 * e.squaredNorm() -
                0.5 * static_cast<double>(e.size()) * std::log(2.0 * 3.14159265358979) +
                0.5 * std::log(static_cast<double>(e.size()));
  for (const double nu : kFreedoms) {
    double sum = 0.0;
    for (const double z : e) sum += t_log_density(z * z, nu);
    if (sum > best) best = sum, noise.freedom = nu;
  }
  if (noise.freedom == 0.0) return;
  const double nu = noise.freedom;
  noise.weight = ((nu + 1.0) / (nu + e.array().square())).sqrt();
}

}  // namespace

Rows rows_of(const Frame& frame, const Eigen::ArrayXd& usable) {
  Rows rows;
  for (std::size_t s = 0; s < frame.segments.size(); ++s) {
    const Segment& one = frame.segments[s];
    Index behind = 0;
    for (Index r = one.first; r < one.first + one.count; ++r) {
      if (!(usable[r] > 0.0)) {
        behind = 0;
        continue;
      }
      rows.row.push_back(r);
      rows.behind.push_back(behind++);
      rows.segment.push_back(s);
    }
  }
  return rows;
}

double NoiseModel::inefficiency() const {
  double sum = 0.0;
  for (const double a : predictor.back()) sum += a;
  const double first = innovation.front();
  return 1.0 / ((1.0 - sum) * (1.0 - sum) * first * first);
}

NoiseModel white_noise(const Rows& rows, std::vector<double> scale) {
  return {{{}}, {1.0}, std::move(scale), Eigen::ArrayXd::Ones(rows.size()), 0.0};
}

MatrixXd whitened(const NoiseModel& noise, const Rows& rows, const MatrixXd& columns) {
  MatrixXd out(columns.rows(), columns.cols());
  const auto p = static_cast<Index>(noise.order());
  for (Index c = 0; c < columns.cols(); ++c) {
    const double* x = columns.col(c).data();
    double* y = out.col(c).data();
    for (Index i = 0; i < columns.rows(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      const auto m = static_cast<std::size_t>(std::min(p, rows.behind[k]));
      const std::vector<double>& a = noise.predictor[m];
      double value = x[i];
      for (std::size_t j = 0; j < m; ++j) value -= a[j] * x[i - static_cast<Index>(j) - 1];
      y[i] = value * noise.weight[i] / (noise.scale[rows.segment[k]] * noise.innovation[m]);
    }
  }
  return out;
}

double log_jacobian(const NoiseModel& noise, const Rows& rows) {
  double sum = 0.0;
  const auto p = static_cast<Index>(noise.order());
  for (std::size_t k = 0; k < rows.row.size(); ++k) {
    const auto m = static_cast<std::size_t>(std::min(p, rows.behind[k]));
    sum += std::log(noise.weight[static_cast<Index>(k)]) -
           std::log(noise.scale[rows.segment[k]] * noise.innovation[m]);
  }
  return sum;
}

NoiseModel fit_noise(const Rows& rows, std::size_t recordings, const VectorXd& residual,
                     double longest_rows) {
  auto r = autocovariance(rows, residual, scales(rows, recordings, residual));
  const auto n = static_cast<double>(rows.size());
  const int most = static_cast<int>(std::clamp(longest_rows, 0.0, double{kHighestOrder}));
  Predictors p = levinson(r, most);
  int order = best_order(p, n);
  const double limit = std::exp(-1.0 / std::max(longest_rows, 1.0));
  const double longest = radius(p.a[static_cast<std::size_t>(order)]);
  if (longest > limit) {
    for (std::size_t k = 1; k < r.size(); ++k)
      r[k] *= std::pow(limit / longest, static_cast<double>(k));
    p = levinson(r, order);
  }
  NoiseModel noise = white_noise(rows, std::vector<double>(recordings, 1.0));
  noise.predictor.assign(p.a.begin(), p.a.begin() + order + 1);
  noise.innovation.clear();
  for (int m = 0; m <= order; ++m) {
    noise.innovation.push_back(std::sqrt(p.variance[static_cast<std::size_t>(m)] /
                                         p.variance[static_cast<std::size_t>(order)]));
  }
  noise.scale = scales(rows, recordings, whitened(noise, rows, residual).col(0));
  weigh(noise, whitened(noise, rows, residual).col(0));
  return noise;
}

}  // namespace flexspline::studies::decision
