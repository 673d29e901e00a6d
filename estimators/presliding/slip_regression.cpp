#include "presliding/slip_regression.hpp"

#include "flexspline/core/law.hpp"
#include "flexspline/core/stop_operator.hpp"

namespace flexspline::estimators {
namespace {

const std::vector<double> kMotionKnots = {0.25, 0.5, 0.75};
// Yields in units of the largest motion: a fixed grid makes the fit linear.
const std::vector<double> kYields = {0.03, 0.06, 0.1, 0.15, 0.22, 0.3, 0.4, 0.5, 0.65, 0.8, 0.95};

// The whole path counts, samples without a residual too: the stops remember it.
Eigen::MatrixXd regressors(const PreparedRecord& one, const Ranges& ranges, const Law& f) {
  const SlipColumns c = slip_columns();
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

}  // namespace

SlipColumns slip_columns() {
  return {.f = static_cast<Eigen::Index>(kMotionKnots.size() + 3),
          .stops = static_cast<Eigen::Index>(kYields.size()),
          .viscous = 1};
}

std::string slip_column_name(Eigen::Index k) {
  const SlipColumns c = slip_columns();
  if (k < c.f) return "f[" + std::to_string(k + 1) + "]";
  if (k < c.f + c.stops) return "stop[" + std::to_string(k - c.f + 1) + "]";
  return "viscous";
}

LawSpec slip_stiffness_law(const Ranges& ranges, const Eigen::VectorXd& x) {
  const auto count = static_cast<std::size_t>(slip_columns().f);
  return {.law = "monotone_spline",
          .scale = ranges.motion,
          .knots = kMotionKnots,
          .coefficients = std::vector<double>(x.data(), x.data() + count),
          .valid_to = ranges.motion};
}

ModelSpec slip_model(const Eigen::VectorXd& x, const Ranges& ranges) {
  const SlipColumns c = slip_columns();
  ModelSpec model;
  model.f = slip_stiffness_law(ranges, x);
  model.g_inverse = {.law = "odd_polynomial",
                     .scale = ranges.velocity,
                     .knots = {},
                     .coefficients = {x[c.f + c.stops]},
                     .valid_to = ranges.velocity};
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

Result<SlipRegression> slip_regression(const std::vector<PreparedRecord>& records,
                                       const Ranges& ranges) {
  const auto f = make_law(slip_stiffness_law(ranges, Eigen::VectorXd::Zero(slip_columns().size())));
  if (!f) return tl::unexpected(f.error());
  Eigen::Index rows = 0;
  for (const auto& one : records) rows += static_cast<Eigen::Index>(one.rows.size());
  SlipRegression linear{Eigen::MatrixXd(rows, slip_columns().size()), Eigen::VectorXd(rows)};
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

}  // namespace flexspline::estimators
