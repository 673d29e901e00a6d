#include "diagnosis/model/law_fit.hpp"
#include "diagnosis/frame/coordinates.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>

#include "diagnosis/frame/baseline.hpp"
#include "diagnosis/model/cause_columns.hpp"
#include "flexspline/core/integrated_basis.hpp"
#include "flexspline/estimators/separable.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array kUnshifted = {0.0, 0.0, 0.0};
constexpr Index kPoints = 400;
constexpr int kElasticKnots = 7;
constexpr int kKnotsOfAGap = 31;
constexpr int kDissipativeKnots = 11;
constexpr int kWidths = 7;

/// The drive in this motion instead of the recorded one, its ranges kept.
Frame moved(const Frame& seen, ArrayXd torsion, ArrayXd rate) {
  Frame frame;
  frame.rig = seen.rig;
  frame.travels = seen.travels;
  frame.firm_spring = seen.firm_spring;
  frame.torsion_range = seen.torsion_range;
  frame.rate_range = seen.rate_range;
  frame.slow_rate = seen.slow_rate;
  frame.time = ArrayXd::LinSpaced(torsion.size(), 0.0, 1.0);
  frame.torsion = std::move(torsion);
  frame.torsion_rate = std::move(rate);
  return frame;
}

// Even over the range, and as many again towards zero, where a law may be steep.
ArrayXd points_on(double range) {
  ArrayXd points(2 * kPoints);
  points.head(kPoints) = ArrayXd::LinSpaced(kPoints, 1.0 / kPoints, 1.0);
  points.tail(kPoints) = ArrayXd::LinSpaced(kPoints, std::log(1e-5), 0.0).exp();
  return range * points;
}

FittedLaw monotone_spline(double scale, std::vector<double> knots, const ArrayXd& x,
                          const ArrayXd& y) {
  const IntegratedBasis basis(knots);
  std::vector<double> value(basis.size());
  MatrixXd columns(x.size(), static_cast<Index>(basis.size()));
  for (Index r = 0; r < x.size(); ++r) {
    basis.values(x[r] / scale, value);
    columns.row(r) = Eigen::Map<const Eigen::RowVectorXd>(value.data(), columns.cols());
  }
  const VectorXd b = nonnegative_fit(columns, y.matrix());
  const double most = y.abs().maxCoeff();
  FittedLaw fitted{{.law = "monotone_spline",
                    .scale = scale,
                    .knots = std::move(knots),
                    .coefficients = {b.begin(), b.end()},
                    .valid_to = scale}};
  if (most > 0.0) fitted.error = (y - (columns * b).array()).abs().maxCoeff() / most;
  return fitted;
}

std::vector<double> even_knots(int count) {
  std::vector<double> knots;
  for (int k = 1; k <= count; ++k) knots.push_back(k / static_cast<double>(count + 1));
  return knots;
}

}  // namespace

VectorXd nonnegative_fit(const MatrixXd& columns, const VectorXd& target) {
  estimators::SeparableProblem problem;
  problem.lower = VectorXd::Zero(columns.cols());
  problem.assemble = [&](std::span<const double>) {
    estimators::SeparableBlock block{columns, target, {}};
    for (Index k = 0; k < columns.cols(); ++k) block.index.push_back(k);
    return std::vector{block};
  };
  return estimators::solve_linear(problem, {}).b;
}

ArrayXd elastic_torque(const Frame& seen, const VectorXd& own, const ArrayXd& torsion) {
  const auto c = baseline_columns(moved(seen, torsion, ArrayXd::Zero(torsion.size())),
                                  Equation::torsion, kUnshifted);
  return c.columns.leftCols(c.elastic) * own.head(c.elastic);
}

FittedLaw elastic_law(const Frame& seen, const VectorXd& own, double range,
                      const std::function<double(double)>& sees) {
  const ArrayXd phi = points_on(range);
  const ArrayXd felt = sees ? ArrayXd(phi.unaryExpr(sees)) : phi;
  const ArrayXd torque = elastic_torque(seen, own, felt);
  return monotone_spline(range, even_knots(sees ? kKnotsOfAGap : kElasticKnots), phi, torque);
}

LawSpec modulation_law(const Frame& seen, std::span<const double> shape, double range,
                       const std::function<double(double)>& sees) {
  LawSpec law{.law = "held_modulation",
              .scale = range,
              .knots = {},
              .coefficients = {shape[0], shape[1]},
              .valid_to = range};
  if (!sees) return law;
  const ArrayXd phi = points_on(range);
  const ArrayXd seen2 = (phi.unaryExpr(sees) / seen.torsion_range).square();
  const ArrayXd u2 = (phi / range).square();
  MatrixXd columns(phi.size(), 2);
  columns << u2.matrix(), u2.square().matrix();
  const VectorXd target = shape[0] * seen2 + shape[1] * seen2.square();
  const VectorXd c = columns.householderQr().solve(target);
  law.coefficients = {c.begin(), c.end()};
  return law;
}

// Its knots as the baseline's: steepest near rest.
FittedLaw dissipative_law(const Frame& seen, const VectorXd& own) {
  const ArrayXd rate = points_on(seen.rate_range);
  const auto c = baseline_columns(moved(seen, ArrayXd::Zero(rate.size()), rate), Equation::torsion,
                                  kUnshifted);
  const ArrayXd torque =
      (c.columns.middleCols(c.elastic, c.dissipative) * own.segment(c.elastic, c.dissipative))
          .array();
  const double slow = std::clamp(seen.slow_rate / seen.rate_range, 1e-3, 0.1);
  return monotone_spline(seen.rate_range, geometric(slow, 0.75, kDissipativeKnots), rate, torque);
}

std::vector<SignPart> sign_parts(const Frame& seen, const ArrayXd& motor_sign) {
  const auto widths = geometric(1e-3 * seen.speed_range, 0.1 * seen.speed_range, kWidths);
  MatrixXd columns(seen.rows(), kWidths);
  for (Index k = 0; k < kWidths; ++k) {
    columns.col(k) = rounded_sign(seen.motor_speed, widths[static_cast<std::size_t>(k)]).matrix();
  }
  const VectorXd shares = nonnegative_fit(columns, motor_sign.matrix());
  std::vector<SignPart> parts;
  for (Index k = 0; k < kWidths; ++k) {
    if (shares[k] > 1e-3) parts.push_back({shares[k], widths[static_cast<std::size_t>(k)]});
  }
  return parts;
}

}  // namespace flexspline::studies
