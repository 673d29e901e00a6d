#include "torsion/torsion_estimate.hpp"

#include "posterior/judge_fit.hpp"
#include "uncertainty/bands.hpp"
#include "uncertainty/estimate_parts.hpp"
#include "uncertainty/torsion_intervals.hpp"

namespace flexspline::estimators {
namespace {

constexpr std::size_t kRememberedBytes = std::size_t{8} << 20U;  // of contents

std::vector<ParameterEstimate> parameters_of(const TrajectoryFit& fit, bool angular) {
  const TorsionLayout& layout = fit.at.layout;
  std::vector<ParameterEstimate> list;
  for (std::size_t k = 0; k < fit.solution.p.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    list.push_back(parameter_estimate(layout.name(k), layout.unit(k, angular), fit.solution.p[k],
                                      fit.covariance(i, i), fit.solution.bound_active[k]));
  }
  return list;
}

std::vector<FunctionBand> bands_of(const TrajectoryFit& fit,
                                   const std::vector<PreparedRecord>& records) {
  const Ranges ranges = ranges_of(records, fit.at.layout.free_terms().zeros);
  const Domain domain{ranges.lowest_motion, ranges.highest_motion, ranges.velocity};
  const Eigen::MatrixXd draws = draws_at_bounds(fit, records);
  return draws.rows() > 0
             ? torsion_bands(fit.at.layout, fit.solution.p, draws, domain, DrawnBands())
             : torsion_bands(fit.at.layout, fit.solution.p, fit.covariance, domain);
}

void take(const Intervals& found, Estimate& estimate) {
  for (std::size_t k = 0; k < found.lower.size(); ++k) {
    estimate.parameters[k].ci95_lower = found.lower[k];
    estimate.parameters[k].ci95_upper = found.upper[k];
    if (!found.std.empty()) estimate.parameters[k].std = found.std[k];
  }
  estimate.notes.insert(estimate.notes.end(), found.notes.begin(), found.notes.end());
}

/// Bands and verdict by what the recordings say without the classes of the laws. Not for zeros of
/// recordings, nor for a joint that travels by another law: no repeats tell its noise.
void judge(const StaticFit& begun, const TrajectoryFit& fit, Estimate& estimate) {
  const auto& records = begun.records;
  const TorsionLayout& layout = fit.at.layout;
  if (layout.free_terms().zeros) {
    estimate.notes.emplace_back(
        "bands within the class: a mixed model is not made of zeros of recordings");
    return;
  }
  if (records.front().record.travels && begun.misses) {
    estimate.notes.emplace_back(
        "bands within the class: the law is refuted and nothing repeats, so that no band holds "
        "what is missing from it");
    return;
  }
  // Where trajectories are simulated from the static fit, both have the same.
  static Remembered<Result<TorsionPosterior>> remembered(kRememberedBytes);
  const auto found = remembered.of(begun.content, [&] {
    return torsion_posterior(records, begun.fit.at.layout, begun.fit.solution.p,
                             begun.decision.free.h > 0);
  });
  const Result<TorsionPosterior>& posterior = *found;
  if (!posterior) {
    estimate.notes.push_back("bands within the class: " + posterior.error().message());
    return;
  }
  const Ranges ranges = ranges_of(records, false);
  auto result = judged(*posterior, layout, fit.solution.p,
                       {ranges.lowest_motion, ranges.highest_motion, ranges.velocity},
                       std::move(estimate.identifiability));
  estimate.bands = std::move(result.bands);
  estimate.identifiability = std::move(result.identifiability);
}

}  // namespace

Result<Estimate> torsion_estimate(std::string estimator, TrajectoryFit fit, const StaticFit& begun,
                                  const TorsionIntervalSettings& settings) {
  const auto& records = begun.records;
  const TermDecision& decision = begun.decision;
  const auto found =
      torsion_intervals(fit, records, settings.uncertainty, settings.solver, settings.integrator);
  if (!found) return tl::unexpected(found.error());
  if (found->covariance.size() > 0) fit.covariance = found->covariance;
  Estimate estimate;
  estimate.estimator = std::move(estimator);
  estimate.model = fit.at.layout.model(fit.solution.p);
  estimate.parameters = parameters_of(fit, !records.front().record.linear);
  estimate.termination = fit.solution.termination;
  estimate.cost = fit.solution.cost;
  estimate.residual =
      fit.direction == Direction::torsion
          ? "torsion: innovations of eq. (3) integrated from the measured torque, in "
            "standard deviations of their noise"
          : "torque: eq. (4) along the measured motion, in standard deviations of "
            "its noise";
  estimate.fits = recording_fits(records, fit.linear.residual);
  estimate.identifiability = {decision.condition, decision.absorbed, decision.verdict,
                              decision.says};
  estimate.bands = bands_of(fit, records);
  estimate.notes = decision.notes;
  estimate.evaluations = fit.solution.evaluations;
  take(*found, estimate);
  if (settings.mixed_model_bands) judge(begun, fit, estimate);
  return estimate;
}

}  // namespace flexspline::estimators
