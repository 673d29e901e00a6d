#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "flexspline/core/law.hpp"
#include "flexspline/core/stop_operator.hpp"
#include "flexspline/estimators/method.hpp"
#include "solvers/nonnegative.hpp"
#include "torsion/prepared_record.hpp"
#include "uncertainty/bands.hpp"
#include "uncertainty/covariance.hpp"
#include "uncertainty/identifiability.hpp"

namespace flexspline::estimators {

MethodRow describe_presliding_nnls();

namespace {

constexpr double kNormal95 = 1.959963984540054;
const std::vector<double> kMotionKnots = {0.25, 0.5, 0.75};
// Yields in units of the largest motion: a fixed grid makes the fit linear.
const std::vector<double> kYields = {0.03, 0.06, 0.1, 0.15, 0.22, 0.3,
                                     0.4,  0.5,  0.65, 0.8, 0.95};

// Columns: f's coefficients, the stiffness of every stop, a linear viscous term.
struct Columns {
  Eigen::Index f, stops, viscous;
  Eigen::Index size() const { return f + stops + viscous; }
};

Columns columns() {
  return {static_cast<Eigen::Index>(kMotionKnots.size() + 3),
          static_cast<Eigen::Index>(kYields.size()), 1};
}

LawSpec stiffness_law(const Ranges& ranges, const Eigen::VectorXd& x) {
  const auto count = static_cast<std::size_t>(columns().f);
  return {.law = "monotone_spline",
          .scale = ranges.motion,
          .knots = kMotionKnots,
          .coefficients = std::vector<double>(x.data(), x.data() + count),
          .valid_to = ranges.motion};
}

// The whole path counts, samples without a residual too: the stops remember it.
Eigen::MatrixXd regressors(const PreparedRecord& one, const Ranges& ranges, const Law& f) {
  const Columns c = columns();
  const auto n = static_cast<Eigen::Index>(one.rows.size());
  Eigen::MatrixXd result(n, c.size());
  std::vector<StopOperator> stops;
  for (double yield : kYields) stops.emplace_back(yield * ranges.motion);
  std::vector<double> gradient(static_cast<std::size_t>(c.f));
  const auto& motion = one.smooth.motion;
  double last = motion.position.front();
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < motion.position.size(); ++i) {
    const double step = motion.position[i] - last;
    last = motion.position[i];
    const bool wanted = row < n && one.rows[static_cast<std::size_t>(row)] == i;
    for (Eigen::Index k = 0; k < c.stops; ++k) {
      const double state = stops[static_cast<std::size_t>(k)].advance(step);
      if (wanted) result(row, c.f + k) = state / ranges.motion;
    }
    if (!wanted) continue;
    f.gradient(motion.position[i], gradient);
    for (Eigen::Index k = 0; k < c.f; ++k) result(row, k) = gradient[static_cast<std::size_t>(k)];
    result(row, c.f + c.stops) = motion.velocity[i] / ranges.velocity;
    ++row;
  }
  return result;
}

struct Linear {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd target;
};

Result<Linear> assemble(const std::vector<PreparedRecord>& records, const Ranges& ranges) {
  const auto f = make_law(stiffness_law(ranges, Eigen::VectorXd::Zero(columns().size())));
  if (!f) return tl::unexpected(f.error());
  Eigen::Index rows = 0;
  for (const auto& one : records) rows += static_cast<Eigen::Index>(one.rows.size());
  Linear linear{Eigen::MatrixXd(rows, columns().size()), Eigen::VectorXd(rows)};
  Eigen::Index row = 0;
  for (const auto& one : records) {
    const auto n = static_cast<Eigen::Index>(one.rows.size());
    linear.matrix.middleRows(row, n) = regressors(one, ranges, **f) / one.effort_noise;
    for (Eigen::Index i = 0; i < n; ++i) {
      linear.target[row + i] =
          one.record.effort[one.rows[static_cast<std::size_t>(i)]] / one.effort_noise;
    }
    row += n;
  }
  return linear;
}

ModelSpec model_of(const Eigen::VectorXd& x, const Ranges& ranges) {
  const Columns c = columns();
  ModelSpec model;
  model.f = stiffness_law(ranges, x);
  model.g_inverse = {.law = "odd_polynomial", .scale = ranges.velocity, .knots = {},
                     .coefficients = {x[c.f + c.stops]}, .valid_to = ranges.velocity};
  model.h = {.law = "bounded_modulation", .scale = ranges.motion, .knots = {}, .coefficients = {}};
  EffectSpec stops{.effect = "presliding_hysteresis", .parameters = {}};
  for (Eigen::Index k = 0; k < c.stops; ++k) {
    if (!(x[c.f + k] > 0.0)) continue;
    stops.parameters.emplace_back("stiffness", x[c.f + k] / ranges.motion);
    stops.parameters.emplace_back("yield", kYields[static_cast<std::size_t>(k)] * ranges.motion);
  }
  if (!stops.parameters.empty()) model.effects.push_back(std::move(stops));
  return model;
}

std::string column_name(Eigen::Index k) {
  const Columns c = columns();
  if (k < c.f) return "f[" + std::to_string(k + 1) + "]";
  if (k < c.f + c.stops) return "stop[" + std::to_string(k - c.f + 1) + "]";
  return "viscous";
}

Estimate estimate_of(const Eigen::VectorXd& x, const Linear& linear,
                     const std::vector<PreparedRecord>& records, const Ranges& ranges) {
  const Columns c = columns();
  std::vector<bool> active;
  for (Eigen::Index k = 0; k < x.size(); ++k) active.push_back(!(x[k] > 0.0));
  const Eigen::VectorXd residual = linear.target - linear.matrix * x;
  const double variance = residual.squaredNorm() / static_cast<double>(residual.size());
  const Eigen::MatrixXd covariance =
      sandwich(linear.matrix, variance * linear.matrix.transpose() * linear.matrix, active);

  Estimate estimate;
  estimate.estimator = "presliding_nnls";
  estimate.model = model_of(x, ranges);
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    ParameterEstimate one{.name = column_name(k), .value = x[k], .unit = records.front().record.linear ? "N" : "Nm",
                          .bound_active = active[static_cast<std::size_t>(k)]};
    if (!one.bound_active) {
      one.std = std::sqrt(covariance(k, k));
      one.ci95_lower = one.value - kNormal95 * one.std;
      one.ci95_upper = one.value + kNormal95 * one.std;
    }
    estimate.parameters.push_back(std::move(one));
  }
  estimate.termination = Termination::converged;
  estimate.cost = 0.5 * residual.squaredNorm();
  estimate.residual = "torque along the measured motion, in standard deviations of its noise";
  Eigen::Index row = 0;
  for (const auto& one : records) {
    const auto n = static_cast<Eigen::Index>(one.rows.size());
    estimate.fits.push_back({one.record.id, Split::train,
                             residual.segment(row, n).norm() / std::sqrt(static_cast<double>(n))});
    row += n;
  }
  const double cosine = largest_cosine(linear.matrix.leftCols(c.f), linear.matrix.middleCols(c.f, c.stops));
  const bool told = cosine < 0.9999;
  estimate.identifiability = {
      .condition = scaled_condition(linear.matrix),
      .absorbed = {{"presliding_hysteresis", "f", cosine}},
      .verdict = told ? "identifiable" : "weak",
      .says = told ? "f and the slip elements can be told apart on these recordings"
                   : "the elastic part of the slip elements and f imitate each other on these "
                     "recordings; their sum is what the loop shows"};
  const auto f = make_law(estimate.model.f);
  const auto g_inverse = make_law(estimate.model.g_inverse);
  expects(f && g_inverse, "the laws of an estimate can be made");
  estimate.bands.push_back(
      law_band("f", **f, covariance.topLeftCorner(c.f, c.f), -ranges.motion, ranges.motion));
  estimate.bands.push_back(law_band("g_inverse", **g_inverse, covariance.bottomRightCorner(1, 1),
                                    -ranges.velocity, ranges.velocity));
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
  const auto linear = assemble(*records, ranges);
  if (!linear) return tl::unexpected(linear.error());
  const Eigen::VectorXd x =
      bounded_least_squares(linear->matrix.transpose() * linear->matrix,
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
          .summary = "f, Maxwell slip on a fixed grid of yields and a linear damper by non-negative "
                     "least squares along the motion",
          .source = "Prandtl and Ishlinskii stop operators; Lawson and Hanson (1974)",
          .options = {},
          .fit = fit};
}

}  // namespace flexspline::estimators
