#include "torque_driven/driven_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "flexspline/core/in_parallel.hpp"
#include "uncertainty/bands.hpp"
#include "uncertainty/estimate_parts.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kFlat = 1e-12;  // relative eigenvalue of J'J below which nothing is known

// SI units of one scaled unit of each coefficient.
std::vector<double> units_of(const DrivenProblem& problem) {
  std::vector<double> unit(static_cast<std::size_t>(problem.f), problem.torque_scale);
  for (int k = 0; k < problem.g; ++k) unit.push_back(std::pow(problem.torque_scale, -(2 * k + 1)));
  unit.resize(problem.size(), 1.0);
  return unit;
}

struct Spectrum {
  Eigen::MatrixXd inverse;  // of J'J, flat directions with the floor
  double condition = kNotComputed;
};

Spectrum spectrum_of(const Eigen::MatrixXd& matrix) {
  Eigen::VectorXd scale = matrix.diagonal().cwiseSqrt();
  for (double& s : scale) s = s > 0.0 ? 1.0 / s : 1.0;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * matrix *
                                                             scale.asDiagonal());
  const double largest = eigen.eigenvalues().maxCoeff();
  const double smallest = eigen.eigenvalues().minCoeff();
  const Eigen::VectorXd inverse = eigen.eigenvalues().cwiseMax(kFlat * largest).cwiseInverse();
  const Eigen::MatrixXd vectors = scale.asDiagonal() * eigen.eigenvectors();
  return {vectors * inverse.asDiagonal() * vectors.transpose(),
          std::sqrt(largest / std::max(smallest, 1e-16 * largest))};
}

ModelSpec model_of(const DrivenProblem& problem, std::span<const double> si) {
  const auto part = [&](int first, int count) {
    const auto values =
        si.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count));
    return std::vector<double>(values.begin(), values.end());
  };
  const double s = problem.motion_scale;
  return {.f = {"odd_polynomial", s, {}, part(0, problem.f), s},
          .g_inverse = {"inverse_odd_polynomial", s, {}, part(problem.f, problem.g), 0.0},
          .h = {"exponential_modulation", s, {}, part(problem.f + problem.g, problem.h), s},
          .effects = {}};
}

ParameterEstimate named(const DrivenProblem& problem, int k, double value, double variance,
                        std::string_view effort) {
  if (k < problem.f) {
    return parameter_estimate(fmt::format("f[{}]", k + 1), std::string(effort), value, variance,
                              false);
  }
  if (k < problem.f + problem.g) {
    const int order = k - problem.f;
    const std::string unit =
        order == 0 ? fmt::format("1/{}", effort) : fmt::format("1/{}^{}", effort, 2 * order + 1);
    return parameter_estimate(fmt::format("g[{}]", order + 1), unit, value, variance, false);
  }
  return parameter_estimate(fmt::format("ln_h[{}]", k - problem.f - problem.g + 1), "1", value,
                            variance, false);
}

Identifiability identifiability_of(const std::vector<ParameterEstimate>& parameters,
                                   double condition) {
  Identifiability result;
  result.condition = condition;
  std::vector<std::string> unknown;
  for (const auto& one : parameters) {
    if (!(one.std < std::abs(one.value))) unknown.push_back(one.name);
  }
  if (condition * condition * kFlat > 1.0) {
    result.verdict = "not_identifiable";
    result.says = fmt::format(
        "some combination of coefficients leaves no trace (condition {:.1g}): trust the curves "
        "within the range, not the coefficients; fit fewer terms",
        condition);
  } else if (!unknown.empty()) {
    result.verdict = "weak";
    result.says = fmt::format("{} cannot be told from zero", fmt::join(unknown, ", "));
  } else {
    result.verdict = "identifiable";
    result.says = "every coefficient can be told from zero";
  }
  return result;
}

double highest_speed(const DrivenProblem& problem) {
  double speed = 0.0;
  for (const auto& one : problem.series) {
    const std::size_t span = one.reading_span;
    for (std::size_t i = span; i < one.time.size(); i += span) {
      speed = std::max(speed, std::abs(one.motion[i] - one.motion[i - span]) /
                                  (one.time[i] - one.time[i - span]));
    }
  }
  return speed * problem.motion_scale;
}

Result<std::vector<FunctionBand>> bands_of(const DrivenProblem& problem, const ModelSpec& model,
                                           const Eigen::MatrixXd& covariance, std::size_t threads) {
  const auto f = make_law(model.f);
  const auto g_inverse = make_law(model.g_inverse);
  const auto h = make_law(model.h);
  for (const auto* law : {&f, &g_inverse, &h}) {
    if (!*law) return tl::unexpected(law->error());
  }
  const auto block = [&](int first, int count) {
    return Eigen::MatrixXd(covariance.block(first, first, count, count));
  };
  const double s = problem.motion_scale;
  const double v = model.g_inverse.valid_to;
  const std::function<FunctionBand()> makers[] = {
      [&] { return law_band("f", **f, block(0, problem.f), -s, s); },
      [&] { return law_band("g_inverse", **g_inverse, block(problem.f, problem.g), -v, v); },
      [&] { return law_band("h", **h, block(problem.f + problem.g, problem.h), -s, s); }};
  std::vector<FunctionBand> bands(problem.h > 0 ? 3 : 2);
  in_parallel(bands.size(), threads, [&](std::size_t k) { bands[k] = makers[k](); });
  return bands;
}

}  // namespace

Result<Estimate> driven_estimate(const DrivenProblem& problem, const DrivenFit& fit, bool linear,
                                 std::size_t threads) {
  if (fit.termination == Termination::failed || fit.termination == Termination::not_run) {
    return failure(ErrorCode::numerics,
                   "eq. (3) cannot be integrated with the values to start from",
                   "look for recordings whose torque and motion do not belong together");
  }
  const std::vector<double> unit = units_of(problem);
  const Spectrum spectrum = spectrum_of(fit.at.matrix);
  const double freedom = static_cast<double>(problem.residuals() - problem.size());
  const Eigen::Map<const Eigen::VectorXd> units(unit.data(),
                                                static_cast<Eigen::Index>(unit.size()));
  const Eigen::MatrixXd covariance =
      2.0 * fit.at.cost / freedom * units.asDiagonal() * spectrum.inverse * units.asDiagonal();
  std::vector<double> si;
  Estimate estimate;
  for (std::size_t k = 0; k < unit.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    si.push_back(fit.p[k] * unit[k]);
    estimate.parameters.push_back(
        named(problem, static_cast<int>(k), si[k], covariance(i, i), linear ? "N" : "Nm"));
  }
  estimate.estimator = "torque_driven";
  estimate.model = model_of(problem, si);
  estimate.model.g_inverse.valid_to = highest_speed(problem);
  auto bands = bands_of(problem, estimate.model, covariance, threads);
  if (!bands) return tl::unexpected(bands.error());
  estimate.bands = std::move(*bands);
  estimate.termination = fit.termination;
  estimate.cost = fit.at.cost;
  estimate.residual =
      "torsion: eq. (3) integrated from the measured torque, over the peak of each recording";
  for (std::size_t s = 0; s < problem.series.size(); ++s) {
    const DrivenSeries& one = problem.series[s];
    estimate.fits.push_back(
        {one.id, Split::train, std::sqrt(fit.at.squares[s] / static_cast<double>(one.counted))});
  }
  estimate.identifiability = identifiability_of(estimate.parameters, spectrum.condition);
  estimate.notes = fit.notes;
  estimate.evaluations = fit.evaluations;
  return estimate;
}

}  // namespace flexspline::estimators
