#include "rig/shaft_equation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "flexspline/estimators/bounded_least_squares.hpp"
#include "uncertainty/covariance.hpp"

namespace flexspline::estimators {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kWidths = 61;
constexpr double kNarrowest = 1e-3;  // of the largest speed
constexpr double kWidest = 0.3;
constexpr double kTwoSided95 = 1.959964;

Eigen::Map<const VectorXd> vector(const std::vector<double>& values) {
  return {values.data(), static_cast<Index>(values.size())};
}

struct Columns {
  MatrixXd value;
  std::vector<std::size_t> constant;  ///< index into the names of the equation, column by column
};

Columns columns_of(const ShaftEquation& equation, bool inertia_stated, double width) {
  const auto speed = vector(equation.speed);
  Columns c;
  if (!inertia_stated) c.constant.push_back(0);
  c.constant.push_back(1);
  if (equation.dry) c.constant.push_back(2);
  c.value.resize(speed.size(), static_cast<Index>(c.constant.size()));
  for (std::size_t k = 0; k < c.constant.size(); ++k) {
    auto column = c.value.col(static_cast<Index>(k));
    if (c.constant[k] == 0) column = vector(equation.acceleration);
    if (c.constant[k] == 1) column = speed;
    if (c.constant[k] == 2) column = (speed.array() / width).tanh();
  }
  return c;
}

struct Solved {
  Columns columns;
  VectorXd value;
  VectorXd residual;
  double width = 0.0;
  double squares = std::numeric_limits<double>::infinity();
};

Solved solve(const ShaftEquation& equation, bool inertia_stated, double width) {
  Solved s{columns_of(equation, inertia_stated, width), {}, {}, width};
  const auto torque = vector(equation.torque);
  const MatrixXd& x = s.columns.value;
  s.value =
      bounded_least_squares(x.transpose() * x, x.transpose() * torque, VectorXd::Zero(x.cols()));
  s.residual = torque - x * s.value;
  s.squares = s.residual.squaredNorm();
  return s;
}

std::vector<double> widths(const ShaftEquation& equation) {
  const double fastest = vector(equation.speed).lpNorm<Eigen::Infinity>();
  if (!equation.dry || !(fastest > 0.0)) return {1.0};
  std::vector<double> list;
  for (int k = 0; k < kWidths; ++k) {
    list.push_back(fastest * kNarrowest *
                   std::pow(kWidest / kNarrowest, k / static_cast<double>(kWidths - 1)));
  }
  return list;
}

/// Variance of the mean of residuals that neighbours share, over that of one.
double noise_of(const VectorXd& residual, Index unknowns) {
  const std::vector<double> series(residual.begin(), residual.end());
  const double wider = std::max(1.0, long_run_ratio(series));
  return wider * residual.squaredNorm() /
         static_cast<double>(std::max<Index>(residual.size() - unknowns, 1));
}

FittedConstant constant_of(const std::string& name, double value, double std) {
  FittedConstant one{{.name = name, .value = value, .std = std, .unit = {}},
                     std::isfinite(std) && value > kTwoSided95 * std};
  one.estimate.ci95_lower = std::max(0.0, value - kTwoSided95 * std);
  one.estimate.ci95_upper = value + kTwoSided95 * std;
  one.estimate.bound_active = value == 0.0;
  return one;
}

}  // namespace

std::vector<FittedConstant> fitted(const ShaftEquation& equation, bool inertia_stated) {
  Solved best;
  double worst = 0.0;
  for (const double width : widths(equation)) {
    Solved trial = solve(equation, inertia_stated, width);
    worst = std::max(worst, trial.squares);
    if (trial.squares < best.squares) best = std::move(trial);
  }
  const MatrixXd& x = best.columns.value;
  const double noise = noise_of(best.residual, x.cols());
  const MatrixXd information = x.transpose() * x;
  const MatrixXd covariance = noise * information.completeOrthogonalDecomposition().pseudoInverse();
  std::vector<FittedConstant> list;
  for (Index k = 0; k < x.cols(); ++k) {
    const bool shown = information(k, k) > 0.0;
    list.push_back(constant_of(
        equation.names[best.columns.constant[static_cast<std::size_t>(k)]], best.value[k],
        shown ? std::sqrt(covariance(k, k)) : std::numeric_limits<double>::infinity()));
  }
  if (!equation.dry) return list;
  FittedConstant width{{.name = equation.names[3], .value = best.width, .unit = {}},
                       worst - best.squares > kTwoSided95 * kTwoSided95 * noise};
  list.push_back(std::move(width));
  return list;
}

}  // namespace flexspline::estimators
