#include <chrono>

#include <Eigen/Dense>

#include "flexspline/core/law.hpp"
#include "flexspline/estimators/bounded_least_squares.hpp"
#include "flexspline/estimators/method.hpp"
#include "presliding/slip_regression.hpp"
#include "uncertainty/bands.hpp"
#include "uncertainty/covariance.hpp"
#include "uncertainty/estimate_parts.hpp"
#include "uncertainty/identifiability.hpp"

namespace flexspline::estimators {
namespace {

Identifiability identifiability_of(const SlipRegression& linear) {
  const SlipColumns c = slip_columns();
  const double cosine =
      largest_cosine(linear.matrix.leftCols(c.f), linear.matrix.middleCols(c.f, c.stops));
  const bool told = cosine < 0.9999;
  return {.condition = scaled_condition(linear.matrix),
          .absorbed = {{"presliding_hysteresis", "f", cosine}},
          .verdict = told ? "identifiable" : "weak",
          .says = told ? "f and the slip elements can be told apart on these recordings"
                       : "the elastic part of the slip elements and f imitate each other on these "
                         "recordings; their sum is what the loop shows. Missing: loops of another "
                         "amplitude and frequency"};
}

std::vector<FunctionBand> bands_of(const ModelSpec& model, const Eigen::MatrixXd& covariance,
                                   const Ranges& ranges) {
  const Eigen::Index size = slip_columns().f;
  const auto f = make_law(model.f);
  const auto g_inverse = make_law(model.g_inverse);
  expects(f && g_inverse, "the laws of an estimate can be made");
  return {law_band("f", **f, covariance.topLeftCorner(size, size), -ranges.motion, ranges.motion),
          law_band("g_inverse", **g_inverse, covariance.bottomRightCorner(1, 1), -ranges.velocity,
                   ranges.velocity)};
}

Estimate estimate_of(const Eigen::VectorXd& x, const SlipRegression& linear,
                     const std::vector<PreparedRecord>& records, const Ranges& ranges) {
  std::vector<bool> active;
  for (Eigen::Index k = 0; k < x.size(); ++k) active.push_back(!(x[k] > 0.0));
  const Eigen::VectorXd residual = linear.target - linear.matrix * x;
  const double variance = residual.squaredNorm() / static_cast<double>(residual.size());
  const Eigen::MatrixXd covariance =
      sandwich(linear.matrix, variance * linear.matrix.transpose() * linear.matrix, active);

  Estimate estimate;
  estimate.estimator = "presliding_nnls";
  estimate.model = slip_model(x, ranges);
  const std::string unit = records.front().record.linear ? "N" : "Nm";
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    estimate.parameters.push_back(parameter_estimate(
        slip_column_name(k), unit, x[k], covariance(k, k), active[static_cast<std::size_t>(k)]));
  }
  estimate.termination = Termination::converged;
  estimate.cost = 0.5 * residual.squaredNorm();
  estimate.residual = "torque along the measured motion, in standard deviations of its noise";
  estimate.fits = recording_fits(records, residual);
  estimate.identifiability = identifiability_of(linear);
  estimate.bands = bands_of(estimate.model, covariance, ranges);
  return estimate;
}

Result<Estimate> fit(const FitProblem& problem) {
  const auto started = std::chrono::steady_clock::now();
  if (problem.records.empty()) {
    return failure(ErrorCode::bad_data, "there is no recording to train on",
                   "mark one with split = \"train\"");
  }
  const auto records = prepare(problem.records, 3000);
  if (!records) return tl::unexpected(records.error());
  const Ranges ranges = ranges_of(*records, false);
  const auto linear = slip_regression(*records, ranges);
  if (!linear) return tl::unexpected(linear.error());
  const Eigen::VectorXd x = bounded_least_squares(linear->matrix.transpose() * linear->matrix,
                                                  linear->matrix.transpose() * linear->target,
                                                  Eigen::VectorXd::Zero(linear->matrix.cols()));
  Estimate estimate = estimate_of(x, *linear, *records, ranges);
  estimate.evaluations = 1;
  estimate.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return estimate;
}

}  // namespace

MethodRow describe_presliding_nnls() {
  return {.id = "presliding_nnls",
          .summary =
              "f, Maxwell slip on a fixed grid of yields and a linear damper by non-negative "
              "least squares along the motion",
          .source = "Prandtl and Ishlinskii stop operators; Lawson and Hanson (1974)",
          .options = {},
          .fit = fit};
}

}  // namespace flexspline::estimators
