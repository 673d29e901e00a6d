#include "uncertainty/covariance.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace flexspline::estimators {
namespace {

constexpr int kLongestLag = 40;
constexpr double kNoInformation = 1e-14;  // relative eigenvalue below which a direction is flat

double lag_one_correlation(std::span<const double> series) {
  double cross = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    total += series[i] * series[i];
    if (i > 0) cross += series[i] * series[i - 1];
  }
  return total > 0.0 ? std::clamp(cross / total, -0.97, 0.97) : 0.0;
}

int bandwidth(std::span<const double> series) {
  const double rho = lag_one_correlation(series);
  const double alpha = 4.0 * rho * rho / std::pow(1.0 - rho * rho, 2);
  const double lags = 1.1447 * std::cbrt(alpha * static_cast<double>(series.size()));
  return std::clamp(static_cast<int>(lags), 0, kLongestLag);
}

double bartlett(int lag, int lags) { return 1.0 - static_cast<double>(lag) / (lags + 1.0); }

}  // namespace

double long_run_ratio(std::span<const double> series) {
  const int lags = bandwidth(series);
  double variance = 0.0;
  for (double y : series) variance += y * y;
  if (!(variance > 0.0)) return 1.0;
  double sum = variance;
  for (int lag = 1; lag <= lags; ++lag) {
    double cross = 0.0;
    for (std::size_t i = static_cast<std::size_t>(lag); i < series.size(); ++i) {
      cross += series[i] * series[i - static_cast<std::size_t>(lag)];
    }
    sum += 2.0 * bartlett(lag, lags) * cross;
  }
  return std::max(sum / variance, 0.1);
}

Eigen::MatrixXd score_covariance(const LeastSquaresProblem& problem, const Linearisation& at) {
  const Eigen::Index columns = at.jacobian.cols();
  Eigen::MatrixXd middle = Eigen::MatrixXd::Zero(columns, columns);
  Eigen::Index row = 0;
  for (std::size_t b = 0; b < problem.blocks(); ++b) {
    const auto height = static_cast<Eigen::Index>(problem.residuals(b));
    const Eigen::VectorXd r = at.residual.segment(row, height);
    const Eigen::MatrixXd score = at.jacobian.middleRows(row, height).array().colwise() * r.array();
    middle += score.transpose() * score;
    const int lags =
        bandwidth(std::span<const double>(r.data(), static_cast<std::size_t>(r.size())));
    for (int lag = 1; lag <= lags; ++lag) {
      const Eigen::MatrixXd cross =
          score.topRows(height - lag).transpose() * score.bottomRows(height - lag);
      middle += bartlett(lag, lags) * (cross + cross.transpose());
    }
    row += height;
  }
  return middle;
}

Eigen::MatrixXd sandwich(const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& middle,
                         const std::vector<bool>& bound_active) {
  std::vector<Eigen::Index> free;
  for (std::size_t k = 0; k < bound_active.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    if (!bound_active[k] && jacobian.col(column).norm() > 0.0) free.push_back(column);
  }
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(jacobian.cols(), jacobian.cols());
  if (free.empty()) return covariance;
  const Eigen::MatrixXd j = jacobian(Eigen::all, free);
  const Eigen::VectorXd scale = j.colwise().norm().cwiseInverse();
  const Eigen::MatrixXd scaled = j * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled.transpose() * scaled);
  const double floor = kNoInformation * eigen.eigenvalues().maxCoeff();
  const Eigen::VectorXd inverse = eigen.eigenvalues().cwiseMax(floor).cwiseInverse();
  const Eigen::MatrixXd bread = scale.asDiagonal() * eigen.eigenvectors() * inverse.asDiagonal() *
                                eigen.eigenvectors().transpose() * scale.asDiagonal();
  // Along a flat direction the middle vanishes too: rounding must not pass for information.
  const Eigen::VectorXd flat =
      (eigen.eigenvalues().array() < floor).select(inverse, Eigen::VectorXd::Zero(inverse.size()));
  const Eigen::MatrixXd unknown = scale.asDiagonal() * eigen.eigenvectors() * flat.asDiagonal() *
                                  eigen.eigenvectors().transpose() * scale.asDiagonal();
  const Eigen::MatrixXd part = bread * middle(free, free) * bread + unknown;
  covariance(free, free) = part;
  return covariance;
}

double standard_deviation(const Eigen::MatrixXd& covariance, std::span<const double> gradient) {
  const Eigen::Map<const Eigen::VectorXd> g(gradient.data(),
                                            static_cast<Eigen::Index>(gradient.size()));
  return std::sqrt(std::max(0.0, g.dot(covariance * g)));
}

}  // namespace flexspline::estimators
