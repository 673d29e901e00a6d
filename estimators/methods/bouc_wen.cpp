#include <chrono>
#include <cmath>

#include "flexspline/core/simulate.hpp"
#include "flexspline/estimators/method.hpp"
#include "solvers/least_squares.hpp"
#include "torsion/prepared_record.hpp"
#include "uncertainty/covariance.hpp"
#include "uncertainty/estimate_parts.hpp"
#include "uncertainty/identifiability.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kDifference = 1e-5;  // of ln r and ln n, for central differences

// Parameters: three odd terms of f and the height H in Nm, ln(r / range), ln n.
enum Index : std::size_t { kFirst, kThird, kFifth, kHeight, kSlip, kExponent, kCount };

ModelSpec model_at(std::span<const double> p, const Ranges& ranges) {
  return {
      .f = {.law = "odd_polynomial",
            .scale = ranges.motion,
            .knots = {},
            .coefficients = {p[kFirst], p[kThird], p[kFifth]},
            .valid_to = ranges.motion},
      .g_inverse = {.law = "odd_polynomial",
                    .scale = ranges.velocity,
                    .knots = {},
                    .coefficients = {0.0},
                    .valid_to = ranges.velocity},
      .h = {.law = "bounded_modulation", .scale = ranges.motion, .knots = {}, .coefficients = {}},
      .effects = {{"bouc_wen",
                   {{"height", p[kHeight]},
                    {"slip_length", ranges.motion * std::exp(p[kSlip])},
                    {"exponent", std::exp(p[kExponent])}}}}};
}

// Linear in the first four; the two shapes by central differences of the simulated torque.
class BoucWenResiduals final : public LeastSquaresProblem {
 public:
  BoucWenResiduals(const std::vector<PreparedRecord>& records, const Ranges& ranges)
      : records_(records), ranges_(ranges) {}

  std::size_t blocks() const override { return records_.size(); }
  std::size_t residuals(std::size_t block) const override { return records_[block].rows.size(); }

  Result<void> evaluate(std::size_t block, std::span<const double> p, std::span<double> residual,
                        std::span<double> jacobian) const override {
    const PreparedRecord& one = records_[block];
    const auto at = simulate_torque(model_at(p, ranges_), one.smooth.motion);
    if (!at) return tl::unexpected(at.error());
    for (std::size_t r = 0; r < residual.size(); ++r) {
      residual[r] = ((*at)[one.rows[r]] - one.record.effort[one.rows[r]]) / one.effort_noise;
    }
    for (std::size_t k = 0; k < kCount && !jacobian.empty(); ++k) {
      std::vector<double> up(p.begin(), p.end());
      std::vector<double> down(p.begin(), p.end());
      const double step = k < kSlip ? 0.5 : kDifference;
      up[k] += step;
      down[k] -= step;
      const auto above = simulate_torque(model_at(up, ranges_), one.smooth.motion);
      const auto below = simulate_torque(model_at(down, ranges_), one.smooth.motion);
      if (!above || !below) return failure(ErrorCode::numerics, "no torque beside the trial point");
      for (std::size_t r = 0; r < residual.size(); ++r) {
        jacobian[r * kCount + k] =
            ((*above)[one.rows[r]] - (*below)[one.rows[r]]) / (2.0 * step * one.effort_noise);
      }
    }
    return {};
  }

 private:
  const std::vector<PreparedRecord>& records_;
  const Ranges& ranges_;
};

std::vector<BoundedParameter> start_at(const Ranges& ranges, double slip) {
  const double effort = ranges.effort;
  const double most = 100.0 * effort;
  std::vector<BoundedParameter> p(kCount);
  p[kFirst] = {0.3 * effort, -most, most, effort};
  p[kThird] = {0.5 * effort, -most, most, effort};
  p[kFifth] = {0.0, -most, most, effort};
  p[kHeight] = {0.2 * effort, 0.0, most, effort};
  p[kSlip] = {std::log(slip), std::log(1e-3), std::log(10.0), 1.0};
  p[kExponent] = {0.0, std::log(0.2), std::log(5.0), 1.0};
  return p;
}

Estimate estimate_of(const LeastSquaresSolution& solution, const Linearisation& at,
                     const std::vector<PreparedRecord>& records, const Ranges& ranges,
                     const BoucWenResiduals& problem) {
  static constexpr std::string_view kNames[] = {
      "f[1]", "f[2]", "f[3]", "height", "ln_slip_over_range", "ln_exponent"};
  const Eigen::MatrixXd covariance =
      sandwich(at.jacobian, score_covariance(problem, at), solution.bound_active);
  Estimate estimate;
  estimate.estimator = "bouc_wen";
  estimate.model = model_at(solution.p, ranges);
  const std::string effort = records.front().record.linear ? "N" : "Nm";
  for (std::size_t k = 0; k < kCount; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    estimate.parameters.push_back(parameter_estimate(std::string(kNames[k]),
                                                     k >= kSlip ? "1" : effort, solution.p[k],
                                                     covariance(i, i), solution.bound_active[k]));
  }
  estimate.termination = solution.termination;
  estimate.cost = solution.cost;
  estimate.residual = "torque along the measured motion, in standard deviations of its noise";
  estimate.fits = recording_fits(records, at.residual);
  estimate.identifiability.condition = scaled_condition(at.jacobian);
  estimate.notes.emplace_back("one internal state: it forgets where earlier reversals were");
  estimate.evaluations = solution.evaluations;
  return estimate;
}

// Two starts of the slip length: the cost has a valley on either side of the loop's own.
Result<Estimate> fit(const FitProblem& problem) {
  const auto started = std::chrono::steady_clock::now();
  if (problem.records.empty()) {
    return failure(ErrorCode::bad_data, "there is no recording to train on",
                   "mark one with split = \"train\"");
  }
  const auto records = prepare(problem.records, 3000);
  if (!records) return tl::unexpected(records.error());
  const Ranges ranges = ranges_of(*records, false);
  const BoucWenResiduals residuals(*records, ranges);
  Result<LeastSquaresSolution> best = failure(ErrorCode::numerics, "no start was tried");
  for (double slip : {0.1, 0.6}) {
    auto solution = minimise(residuals, start_at(ranges, slip), {.max_iterations = 40});
    if (solution && (!best || solution->cost < best->cost)) best = std::move(solution);
    if (!solution && !best) best = std::move(solution);
  }
  if (!best) return tl::unexpected(best.error());
  const auto at = linearise(residuals, best->p);
  if (!at) return tl::unexpected(at.error());
  Estimate estimate = estimate_of(*best, *at, *records, ranges, residuals);
  estimate.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return estimate;
}

}  // namespace

MethodRow describe_bouc_wen() {
  return {.id = "bouc_wen",
          .summary = "an odd polynomial f and one Bouc-Wen state, by Ceres along the motion",
          .source = "Dahl (1968), Wen (1976)",
          .options = {},
          .fit = fit};
}

}  // namespace flexspline::estimators
